// The sun as flat mirrors reflect it onto other surfaces: for each mirror a light that shines through the mirror's
// rectangle, as the sun of a mirrored world through a window. Diffuse rays would find this light only where they hit a
// mirror and look straight at the sun in it, so almost never: in a room with a mirror floor it is a sixth of all light.
#pragma once

#include "effects/lamps.h"
#include "renderer/planar_views/mirrors.h"

#include <span>
#include <vector>

namespace reflet {

/// toSun: unit. irradiance: on a surface that faces the sun [W/m²]. angularDiameter: of the sun [rad]. The `count`
/// mirrors that reflect most light, of those that are smooth and reflect at least a tenth. Curved mirrors have none.
std::vector<LampParams> reflectedSuns(std::span<const FlatPiece> pieces, const vec3& toSun, const vec3& irradiance,
                                      float angularDiameter, uint32_t count);

}  // namespace reflet
