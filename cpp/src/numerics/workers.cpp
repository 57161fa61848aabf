// SPDX-License-Identifier: Apache-2.0
#include "numerics/workers.hpp"

namespace carom {
namespace {

// Turns of a wait before it sleeps: some ten microseconds, as long as the work between two meetings
// takes. On a busy machine the one waited for may need this very processor, and who slept is woken
// at once where who only stood back waits for its turn.
constexpr int turns = 2048;
// Turns an idle worker waits for the next task before it sleeps: the gaps between tasks of a step.
constexpr int idle_turns = 16 * turns;

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Returns once `value` is no longer `old`.
template <class T>
void wait_while(const std::atomic<T>& value, T old, int spins) {
  for (int turn = 0; turn < spins; ++turn) {
    if (value.load(std::memory_order_acquire) != old) return;
    pause();
  }
  value.wait(old, std::memory_order_acquire);
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
    wait_while(round_, seen, idle_turns);
    ++seen;  // the next task starts only when all have ended this one
    if (ending_.load(std::memory_order_relaxed)) return;
    call_(context_, {index, count()});
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_all();
  }
}

void Workers::start(Call call, void* context) {
  call_ = call, context_ = context;
  busy_.store(count() - 1, std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  call(context, {0, count()});
  for (int left; (left = busy_.load(std::memory_order_acquire)) != 0;)
    wait_while(busy_, left, turns);
}

void Workers::meet() {
  const unsigned meeting = meeting_.load(std::memory_order_relaxed);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == count()) {
    arrived_.store(0, std::memory_order_relaxed);
    meeting_.store(meeting + 1, std::memory_order_release);
    meeting_.notify_all();
  } else {
    wait_while(meeting_, meeting, turns);
  }
}

}  // namespace carom
