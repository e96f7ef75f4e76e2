// A table of directional albedos.
#pragma once

#include "base/math.h"

#include <vector>

namespace reflet {

/// Two values, tabulated over the cosine between normal and viewer and the perceptual roughness, both 0..1, with
/// interpolation between evenly spaced entries.
class AlbedoTable {
public:
    /// Calls integrate(cosine, roughness) for each entry, from several threads.
    explicit AlbedoTable(vec2 (*integrate)(float cosine, float roughness));

    [[nodiscard]] vec2 at(float cosine, float roughness) const;

private:
    std::vector<vec2> entries_;
};

}  // namespace reflet
