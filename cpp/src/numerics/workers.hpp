// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <thread>
#include <vector>

namespace carom {

/// A share of work: the index-th of `count` nearly equal parts.
struct Part {
  int index = 0, count = 1;

  [[nodiscard]] int begin(int n) const { return at(n, index); }
  [[nodiscard]] int end(int n) const { return at(n, index + 1); }

 private:
  [[nodiscard]] int at(int n, int i) const {
    return static_cast<int>(static_cast<long long>(n) * i / count);
  }
};

/// Threads that share the work of a step: the caller's and those kept here. Who takes which part
/// never decides a result. Nothing is allocated after construction.
class Workers {
 public:
  explicit Workers(int threads);  ///< >= 1, the caller's included
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int count() const { return static_cast<int>(threads_.size()) + 1; }

  /// Calls task(Part) once per thread, at the same time, and returns when all have returned. The
  /// task must not throw.
  template <class Task>
  void run(Task& task) {
    start([](void* context, Part part) noexcept { (*static_cast<Task*>(context))(part); }, &task);
  }
  /// Inside a task: waits until all parts have come here; what they wrote before is seen after.
  void meet();

 private:
  using Call = void (*)(void*, Part) noexcept;
  void start(Call call, void* context);
  void serve(int index);

  std::vector<std::thread> threads_;
  Call call_ = nullptr;
  void* context_ = nullptr;
  // Each on a cache line of its own: they are written by all.
  alignas(64) std::atomic<unsigned> round_{0};  // goes up with every task, and to end
  alignas(64) std::atomic<int> busy_{0};
  alignas(64) std::atomic<int> arrived_{0};
  alignas(64) std::atomic<unsigned> meeting_{0};
  std::atomic<bool> ending_{false};
};

/// Runs the task on all workers, or as one part on the caller's thread where there are none.
template <class Task>
void share(Workers* workers, Task&& task) {
  if (workers != nullptr)
    workers->run(task);
  else
    task(Part{});
}

}  // namespace carom
