// Small scenes with known answers, path traced.
#pragma once

#include "reference/reference.h"
#include "scene/builtin/assemble.h"

#include <gtest/gtest.h>

#include <string>

namespace reflet::test {

/// Without sun, environment and lamps; looks from one point at another.
View darkView(const vec3& position, const vec3& target, float fovYDegrees = 40.0F);

/// The colour for which Bsdf is pure Lambert of that albedo if ReferenceOptions::lambertOnly.
Material matt(const vec3& albedo, const vec3& emissive = vec3(0.0F));

/// Adds a thing in a material of its own.
void add(Scene& scene, const Material& material, Mesh mesh, const mat4& objectToWorld = mat4(1.0F));

/// A square, its front toward `normal`, which is along an axis.
Mesh square(const vec3& center, const vec3& normal, float halfSize, const glm::uvec2& cells = {1, 1});

/// Lambert only, and otherwise as given.
ReferenceOptions lambert(uint32_t bounces, uint32_t samples);

/// Mean over the whole picture.
vec3 mean(const FloatImage& image);
float pixel(const FloatImage& image, uint32_t x, uint32_t y, uint32_t channel = 0);
vec3 color(const FloatImage& image, uint32_t x, uint32_t y);

}  // namespace reflet::test
