// What most files include, compiled once: the build's alone. Each file still includes what it needs, and the sanitize
// preset builds without this one.
#pragma once

#include "base/error.h"
#include "base/math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
