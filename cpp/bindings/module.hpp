// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

void bind_errors(pybind11::module_& m);
void bind_ccd(pybind11::module_& m);
void bind_sweep(pybind11::module_& m);
void bind_broad(pybind11::module_& m);
void bind_mass_properties(pybind11::module_& m);
void bind_mesh_diagnosis(pybind11::module_& m);
void bind_particles(pybind11::module_& m);
void bind_shapes(pybind11::module_& m);
void bind_effects(pybind11::module_& m);
void bind_scene(pybind11::module_& m);
void bind_plan(pybind11::module_& m);
void bind_report(pybind11::module_& m);
void bind_pairs(pybind11::module_& m);
void bind_simulation(pybind11::module_& m);
void bind_free_flight(pybind11::module_& m);
