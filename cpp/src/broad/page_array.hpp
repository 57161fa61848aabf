// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace carom::broad {

/// Blocks of large arrays that were let go, for the next ones of the thread: the system clears
/// every page it hands out, which takes up to half of the time of a build. Holds the few largest of
/// a rebuild, 64 MiB at most.
class PageStore {
 public:
  struct Block {
    void* data = nullptr;
    std::size_t bytes = 0;
  };
  /// A block of at least `bytes` that is not much larger; {} where there is none.
  Block take(std::size_t bytes) {
    for (Block& b : blocks_)
      if (b.bytes >= bytes && b.bytes / 2 <= bytes) {
        held_ -= b.bytes;
        return std::exchange(b, {});
      }
    return {};
  }
  /// Whether the block was kept; else it is the caller's to free.
  bool keep(Block block) {
    if (block.bytes + held_ > most_held) return false;
    for (Block& b : blocks_)
      if (b.data == nullptr) {
        b = block;
        held_ += block.bytes;
        return true;
      }
    return false;
  }
  /// Null once the thread lets go of what it owns: an array may outlive that.
  static PageStore* of_thread() {
    if (gone()) return nullptr;
    thread_local PageStore store;
    return &store;
  }
  PageStore() = default;
  PageStore(const PageStore&) = delete;
  PageStore& operator=(const PageStore&) = delete;
  ~PageStore() {
    for (const Block& b : blocks_) std::free(b.data);
    gone() = true;
  }

 private:
  static bool& gone() {
    thread_local bool is = false;
    return is;
  }

  static constexpr std::size_t most_held = std::size_t{64} << 20;
  std::array<Block, 6> blocks_{};
  std::size_t held_ = 0;
};

/// Uninitialised memory for large arrays of plain data. Asks for huge pages where the system has
/// them: random walks through a large tree otherwise spend much of their time on address
/// translation.
template <class T>
class PageArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  PageArray() = default;
  explicit PageArray(std::size_t count) : count_(count) {
    if (count == 0) return;
    constexpr std::size_t huge = std::size_t{1} << 21;
    const std::size_t bytes = count * sizeof(T);
    const std::size_t align = bytes >= huge ? huge : 64;
    const std::size_t rounded = (bytes + align - 1) / align * align;
    if (bytes >= huge) {
      PageStore* store = PageStore::of_thread();
      const PageStore::Block kept = store ? store->take(rounded) : PageStore::Block{};
      data_ = {static_cast<T*>(kept.data), Free{kept.bytes}};
      if (data_ != nullptr) return;
    }
    data_ = {static_cast<T*>(std::aligned_alloc(align, rounded)),
             Free{bytes >= huge ? rounded : 0}};
    if (data_ == nullptr) throw std::bad_alloc();
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (bytes >= huge) madvise(data_.get(), rounded, MADV_HUGEPAGE);
#endif
  }
  [[nodiscard]] T* data() { return data_.get(); }
  [[nodiscard]] const T* data() const { return data_.get(); }
  [[nodiscard]] std::size_t size() const { return count_; }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    std::size_t bytes = 0;  ///< of a block worth keeping
    void operator()(T* p) const {
      PageStore* store = bytes ? PageStore::of_thread() : nullptr;
      if (!store || !store->keep({p, bytes})) std::free(p);
    }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t count_ = 0;
};

}  // namespace carom::broad
