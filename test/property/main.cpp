/// Runs properties with a fixed seed, so that a test that passed passes again. Other cases, or more
/// of them:
///
///     RC_PARAMS="seed=42 max_success=5000" symmetry_property_test
///
/// A failure prints its case and, as `reproduce=...`, what RC_PARAMS must hold to run just that
/// case.

#include <cstdlib>

#include <gtest/gtest.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  setenv("RC_PARAMS", "seed=20020915 max_success=400", 0);  // what is set stays
  return RUN_ALL_TESTS();
}
