// Paths that end in the radiance cache: all bounces, no light through walls, the same bytes each time, and how soon it
// forgets.
#include "pass/harness.h"
#include "reference/reference.h"

#include <numeric>

namespace reflet::test::radiance_cache_test {
namespace {

constexpr uvec2 size(36, 20);

// Rays through the scene alone, so that all light of bounces is the cache's.
const std::vector<std::string> byPaths{"trace_screen.enabled=false",
                                       "trace_screen.light=previous",
                                       "trace_scene.enabled=true",
                                       "trace_scene.reuse_screen=false",
                                       "specular.rays=0",
                                       "diffuse.rays=4",
                                       "materials.lambert_only=true"};

Settings cached(const std::vector<std::string>& more = {}) {
    std::vector<std::string> all = byPaths;
    all.emplace_back("radiance_cache.enabled=true");
    all.insert(all.end(), more.begin(), more.end());
    return settingsOf(all);
}

double meanOf(const FloatImage& image) {
    return std::accumulate(image.data.begin(), image.data.end(), 0.0) / double(image.data.size());
}

// A closed room from -half to half, seen from inside; walls of `thickness` inward.
void addRoom(Scene& scene, uint32_t material, const vec3& center, const vec3& half, float thickness) {
    const auto wall = [&](const vec3& at, const vec3& extent) {
        builtin::place(scene, "wall", material, builtin::box(extent), builtin::at(center + at));
    };
    for (const float side : {-1.0F, 1.0F}) {
        wall({side * (half.x + thickness), 0, 0}, {thickness, half.y + 2 * thickness, half.z + 2 * thickness});
        wall({0, side * (half.y + thickness), 0}, {half.x + thickness, thickness, half.z + thickness});
        wall({0, 0, side * (half.z + thickness)}, {half.x + thickness, half.y, thickness});
    }
}

Lamp lampAt(const vec3& position, float intensity) {
    Lamp lamp;
    lamp.type = Lamp::Type::point;
    lamp.position = position;
    lamp.intensity = vec3(intensity);
    return lamp;
}

View viewFrom(const vec3& position, const vec3& target) {
    View view;
    view.camera = builtin::camera("eye", position, target, 60.0F);
    view.sun.irradiance = vec3(0.0F);
    view.environment = {};
    return view;
}

Scene whiteRoom() {
    Scene scene;
    addRoom(scene, builtin::addMaterial(scene, lambertMaterial(vec3(0.8F))), {0, 0, 0}, {2, 1.5F, 2}, 0.05F);
    scene.lamps.push_back(lampAt({0.7F, 0.9F, 0.3F}, 3.0F));
    return scene;
}

// Walls of albedo 0.8 send light through a dozen bounces. One bounce behind each hit brings less than 70 % of it. What
// the cache still lacks is from its memory of earlier frames, in which it knew fewer bounces. Over 5 s: many rays.
TEST(RadianceCache, BringsNearlyAllBounces) {
    const Scene scene = whiteRoom();
    const View view = viewFrom({-1.5F, 0.2F, 1.5F}, {0.5F, -0.3F, -1});
    const ReferencePicture truth =
        traceReference(scene, view, size, {.samples = 256, .filter = PixelFilter::center, .lambertOnly = true});
    const double all = meanOf(truth.indirectDiffuse);
    const auto of = [&](const Settings& settings) {
        return meanOf(render(scene, view, size, settings, {"indirect_diffuse"}, 32).images.at("indirect_diffuse"));
    };
    EXPECT_LT(of(settingsOf(byPaths)), 0.7 * all);
    EXPECT_NEAR(of(cached()), 0.93 * all, 0.07 * all);
}

// Two rooms beside each other, floor and ceiling in one, a wall of 5 cm between them; only one has light. The camera
// stands in the dark one, near the wall.
TEST(RadianceCache, LightStaysOnItsSideOfAThinWall) {
    Scene scene;
    const uint32_t white = builtin::addMaterial(scene, lambertMaterial(vec3(0.8F)));
    addRoom(scene, white, {0, 0, 0}, {4, 1.5F, 2}, 0.1F);
    builtin::place(scene, "thin wall", white, builtin::box({0.025F, 1.5F, 2}), builtin::at({0, 0, 0}));
    scene.lamps.push_back(lampAt({-2, 0.5F, 0}, 20.0F));
    const View bright = viewFrom({-3.5F, 0.2F, 1.5F}, {0, -0.5F, -0.5F});
    const View dark = viewFrom({0.6F, 0.2F, 0.8F}, {0, -0.8F, -0.4F});
    std::vector<View> path(24, bright);
    path.insert(path.end(), 24, dark);
    const std::vector<Pictures> frames = renderPath(scene, path, size, cached(), {"final"});
    const double light = meanOf(frames[23].images.at("final"));
    EXPECT_GT(light, 0.1);
    const FloatImage& last = frames.back().images.at("final");
    EXPECT_LT(meanOf(last), 1e-3 * light);
    EXPECT_LT(*std::ranges::max_element(last.data), 0.02 * light);
}

TEST(RadianceCache, GivesTheSameBytesEachTime) {
    const Scene scene = whiteRoom();
    const View view = viewFrom({-1.5F, 0.2F, 1.5F}, {0.5F, -0.3F, -1});
    const auto once = [&] { return render(scene, view, size, cached(), {"final"}, 12).images.at("final").data; };
    EXPECT_EQ(once(), once());
}

// Half-life of the light that a lamp has left behind, in frames.
TEST(RadianceCache, ForgetsALampThatIsSwitchedOff) {
    const Scene scene = whiteRoom();
    const View on = viewFrom({-1.5F, 0.2F, 1.5F}, {0.5F, -0.3F, -1});
    View off = on;
    off.lampsOff = {0};
    std::vector<View> path(24, on);
    path.insert(path.end(), 13, off);
    const std::vector<Pictures> frames = renderPath(scene, path, size, cached(), {"indirect_diffuse"});
    const auto light = [&](size_t frame) { return meanOf(frames[frame].images.at("indirect_diffuse")); };
    EXPECT_LT(light(24 + 5), 0.5 * light(23));
    EXPECT_LT(light(24 + 12), 0.25 * light(23));
}

}  // namespace
}  // namespace reflet::test::radiance_cache_test
