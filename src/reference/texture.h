// Texture lookup, bilinear or nearest; without mips, because a pixel has many samples.
#pragma once

#include "scene/scene.h"

namespace reflet {

/// RGBA in 0..1 of a slot with an image. srgb: decode the colours. uv outside of 0..1 wrap as in the slot's sampler.
vec4 readTexture(const Scene& scene, const TextureSlot& slot, const vec2& uv0, const vec2& uv1, bool srgb);

}  // namespace reflet
