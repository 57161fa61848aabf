// SPDX-License-Identifier: Apache-2.0
#pragma once
// Everything, for programs that do not mind.
#include "carom/bodies/mass_properties.hpp"
#include "carom/narrow/moving_triangle.hpp"
#include "carom/narrow/sweep.hpp"
#include "carom/numerics/roots.hpp"
#include "carom/scene/scene.hpp"
#include "carom/state/report.hpp"
#include "carom/step/plan.hpp"
#include "carom/step/simulation.hpp"
