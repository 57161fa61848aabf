// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <mutex>

#include <pybind11/pybind11.h>

#include "carom/step/simulation.hpp"

namespace carom::python {

namespace py = pybind11;

/// A simulation that other Python threads may read while one steps it without the GIL.
class Shared {
 public:
  Shared(const Scene& scene, const SimulationOptions& options) : simulation_(scene, options) {}

  /// Runs `work(simulation)` alone, with the GIL held. Waits for the other thread without the GIL,
  /// or that thread could never finish.
  template <class Work>
  auto with(Work work) {
    std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock()) {
      py::gil_scoped_release release;
      lock.lock();
    }
    return work(simulation_);
  }
  /// The same without the GIL: for work that touches no Python object.
  template <class Work>
  auto without_gil(Work work) {
    py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    return work(simulation_);
  }

 private:
  Simulation simulation_;
  std::mutex mutex_;
};

/// Questions to the bodies as they stand: raycast, segments, shape_cast, overlaps, closest, ...
void bind_queries(py::class_<Shared>& cls);

}  // namespace carom::python
