// Path traces small scenes with known results.
#pragma once

#include "reference/reference.h"
#include "scene/builtin/assemble.h"

#include <gtest/gtest.h>

#include <string>

namespace reflet::test {

/// A view from one point at another, without sun, environment and lamps.
View darkView(const vec3& position, const vec3& target, float fovYDegrees = 40.0F);

/// A diffuse material of that albedo: with ReferenceOptions::lambertOnly its Bsdf is pure Lambert.
Material lambertMaterial(const vec3& albedo, const vec3& emissive = vec3(0.0F));

/// Adds an instance of the mesh with its own material.
void add(Scene& scene, const Material& material, Mesh mesh, const mat4& objectToWorld = mat4(1.0F));

/// A square that faces `normal`, which is along an axis.
Mesh square(const vec3& center, const vec3& normal, float halfSize, const glm::uvec2& cells = {1, 1});

/// Options with lambertOnly.
ReferenceOptions lambert(uint32_t bounces, uint32_t samples);

/// Mean over the whole image.
vec3 mean(const FloatImage& image);
float pixel(const FloatImage& image, uint32_t x, uint32_t y, uint32_t channel = 0);
vec3 color(const FloatImage& image, uint32_t x, uint32_t y);

}  // namespace reflet::test
