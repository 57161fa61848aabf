// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace carom {

struct World;

/// Contacts of balls and particles whose centres lie inside a distance grid: takes their normals
/// from the lecture's chain, and counts which was used. After run_contacts.
void refine_interior_contacts(World& world);

}  // namespace carom
