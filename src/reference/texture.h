// Reads the scene's images as materials see them: bilinear or nearest, without mips, since a pixel is many samples.
#pragma once

#include "scene/scene.h"

namespace reflet {

/// Four channels 0..1 of a slot that has an image; `srgb`: the colours are decoded. Outside of 0..1 the slot's sampler
/// decides.
vec4 readTexture(const Scene& scene, const TextureSlot& slot, const vec2& uv0, const vec2& uv1, bool srgb);

}  // namespace reflet
