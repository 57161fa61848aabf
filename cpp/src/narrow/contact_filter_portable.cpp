// SPDX-License-Identifier: Apache-2.0
#define CAROM_TARGET portable
#include "contact_filter_lanes.hpp"
