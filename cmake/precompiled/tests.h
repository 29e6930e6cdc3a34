// The same for tests.
#include "cmake/precompiled/product.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
