// What most tests include, compiled once: the build's alone, as src/precompiled.h.
#pragma once

#include "precompiled.h"

#include <gtest/gtest.h>
