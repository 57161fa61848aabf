// SPDX-License-Identifier: Apache-2.0
#include "broad/page_array.hpp"

#include <cstdint>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

namespace carom::broad {
namespace {

constexpr std::size_t large = std::size_t{4} << 20;  // bytes

TEST(PageArray, TakesTheBlockThatWasLetGoBefore) {
  auto first = PageArray<std::uint8_t>(large);
  const std::uint8_t* place = first.data();
  first = PageArray<std::uint8_t>();
  const PageArray<std::uint8_t> again(large - 100), other(large);
  EXPECT_EQ(again.data(), place);
  EXPECT_NE(other.data(), place);
}

TEST(PageArray, HoldsNoBlockForWhatIsMuchSmaller) {
  auto first = PageArray<std::uint8_t>(8 * large);
  const std::uint8_t* place = first.data();
  first = PageArray<std::uint8_t>();
  const PageArray<std::uint8_t> small(large);
  EXPECT_NE(small.data(), place);
}

TEST(PageStore, KeepsNoMoreThanItMay) {
  std::thread([] {  // a store of its own
    PageStore& store = *PageStore::of_thread();
    const std::size_t most = std::size_t{64} << 20;
    void* block = std::malloc(1);
    EXPECT_FALSE(store.keep({block, most + 1}));
    ASSERT_TRUE(store.keep({block, most}));
    void* second = std::malloc(1);
    EXPECT_FALSE(store.keep({second, 1}));
    EXPECT_EQ(store.take(most).data, block);
    EXPECT_TRUE(store.keep({second, 1}));
    std::free(block);
  })
      .join();
}

TEST(PageArray, MayDieInAnotherThreadAndAfterItsOwn) {
  PageArray<std::uint8_t> here;
  std::thread([&] {
    thread_local PageArray<std::uint8_t> late(large);
    here = PageArray<std::uint8_t>(large);
    here[large - 1] = 7;
    late[0] = 1;
  }).join();
  EXPECT_EQ(here[large - 1], 7);
}

}  // namespace
}  // namespace carom::broad
