// SPDX-License-Identifier: Apache-2.0
#include "numerics/workers.hpp"

namespace carom {
namespace {

// Turns of a wait before the processor is offered to others: some microseconds, as long as the work
// between two meetings takes. On a busy machine the one waited for may need this very processor.
constexpr int turns = 2048;
// Turns an idle worker waits for the next task before it sleeps: the gaps between tasks of a step.
constexpr int idle_turns = 16 * turns;

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

template <class Done>
void wait_until(Done done) {
  for (int turn = 0; !done(); ++turn) {
    if (turn < turns)
      pause();
    else
      std::this_thread::yield();
  }
}

}  // namespace

Workers::Workers(int threads) {
  threads_.reserve(threads > 1 ? static_cast<std::size_t>(threads - 1) : 0);
  for (int i = 1; i < threads; ++i) threads_.emplace_back([this, i] { serve(i); });
}

Workers::~Workers() {
  ending_.store(true, std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::serve(int index) {
  for (unsigned seen = 0;;) {
    for (int turn = 0; turn < idle_turns && round_.load(std::memory_order_acquire) == seen; ++turn)
      pause();
    round_.wait(seen, std::memory_order_acquire);
    ++seen;  // the next task starts only when all have ended this one
    if (ending_.load(std::memory_order_relaxed)) return;
    call_(context_, {index, count()});
    busy_.fetch_sub(1, std::memory_order_release);
  }
}

void Workers::start(Call call, void* context) {
  call_ = call, context_ = context;
  busy_.store(count() - 1, std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  call(context, {0, count()});
  wait_until([&] { return busy_.load(std::memory_order_acquire) == 0; });
}

void Workers::meet() {
  const unsigned meeting = meeting_.load(std::memory_order_relaxed);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == count()) {
    arrived_.store(0, std::memory_order_relaxed);
    meeting_.store(meeting + 1, std::memory_order_release);
  } else {
    wait_until([&] { return meeting_.load(std::memory_order_acquire) != meeting; });
  }
}

}  // namespace carom
