// Sunlight that flat mirrors reflect onto other surfaces: for each mirror, a light that shines through the mirror's
// rectangle, as the sun of a mirrored world through a window. Diffuse rays almost never find this light, because they
// would have to hit a mirror in the sun's exact direction; in a room with a mirror floor it is a sixth of all light.
#pragma once

#include "effects/lamps.h"
#include "renderer/planar_views/mirrors.h"

#include <span>
#include <vector>

namespace reflet {

/// Lights for the `count` mirrors that reflect the most light, among those that are smooth and reflect at least a
/// tenth. Curved mirrors have none. toSun: unit. irradiance: on a surface that faces the sun [W/m²]. angularDiameter:
/// of the sun [rad].
std::vector<LampParams> reflectedSuns(std::span<const FlatPiece> pieces, const vec3& toSun, const vec3& irradiance,
                                      float angularDiameter, uint32_t count);

}  // namespace reflet
