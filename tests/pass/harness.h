// Renders small scenes for tests with validation layers, and returns the images of the frame as values.
//
// Choose sizes with sides that are no powers of two, and whose halves are none: llvmpipe compiles each shader again for
// textures with a side that is one, and compiling takes most of the tests' time.
#pragma once

#include "base/image_file.h"
#include "renderer/renderer.h"
#include "scene/builtin/assemble.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace reflet::test {

/// Images by --show name.
struct Pictures {
    uvec2 size{0};
    ViewParams view{};
    std::map<std::string, FloatImage> images;

    [[nodiscard]] float value(const std::string& show, unsigned x, unsigned y, unsigned channel = 0) const;
    [[nodiscard]] vec3 color(const std::string& show, unsigned x, unsigned y) const;
    /// World position of the surface at a pixel, from the depth image; only where depth > 0.
    [[nodiscard]] vec3 position(unsigned x, unsigned y) const;
    [[nodiscard]] bool hasSurface(unsigned x, unsigned y) const { return value("depth", x, y) > 0.0F; }
};

/// The last of `frames` frames.
Pictures render(const Scene& scene, const View& view, uvec2 size, const Settings& settings,
                const std::vector<std::string>& shows, uint32_t frames = 1);

/// The mean of all of `frames` frames, which differ in their noise.
Pictures renderMean(const Scene& scene, const View& view, uvec2 size, const Settings& settings,
                    const std::vector<std::string>& shows, uint32_t frames, uint32_t seed = 0);

/// Renders frames of `before`, then one of `now`, and returns the images of that.
Pictures renderMoved(const Scene& scene, const View& before, const View& now, uvec2 size, const Settings& settings,
                     const std::vector<std::string>& shows, uint32_t framesBefore = 1);

/// A frame from each view, one after the other.
std::vector<Pictures> renderPath(const Scene& scene, const std::vector<View>& path, uvec2 size,
                                 const Settings& settings, const std::vector<std::string>& shows);

/// Renders a frame of size `before`, then one of size `now`, and returns the images of that.
Pictures renderResized(const Scene& scene, const View& view, uvec2 before, uvec2 now, const Settings& settings,
                       const std::vector<std::string>& shows);

/// The names of the passes of a frame.
std::vector<std::string> passNames(const Scene& scene, const View& view, uvec2 size, const Settings& settings);

/// The default view from another place.
View viewFrom(const vec3& position, const vec3& target);

/// Unit direction from the eye through a pixel's centre.
vec3 pixelDirection(const Camera& camera, uvec2 size, unsigned x, unsigned y);

/// Settings from assignments: settingsOf({"diffuse.rays=0", …}).
Settings settingsOf(const std::vector<std::string>& assignments);

/// Smallest value, largest value, and whether all are finite.
struct Range {
    float min = 0.0F;
    float max = 0.0F;
    bool finite = true;
};
Range rangeOf(const FloatImage& image);

/// Expects no validation messages since the last call.
void expectSilentValidation(const std::string& during);

/// An empty scene with one material a call.
Material lambertMaterial(const vec3& albedo);

/// A scene of one mesh in one material.
Scene sceneOf(const Material& material, Mesh mesh);

}  // namespace reflet::test
