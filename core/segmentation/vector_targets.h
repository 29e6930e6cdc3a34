#pragma once

// To be included before Highway, in every file that is compiled for several targets: vectors of unknown
// length cannot stand in arrays and classes; ARM is served by NEON.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE_256 | HWY_SVE2 | HWY_SVE2_128 | HWY_RVV)
