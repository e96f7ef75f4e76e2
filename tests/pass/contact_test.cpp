// Contact shadows: they find what the shadow map misses, and darken nothing that is lit.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "scene/builtin.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::contact_test {
namespace {

constexpr uvec2 size(200, 112);

Settings with(std::vector<std::string> assignments) {
    assignments.insert(assignments.end(), {"diffuse.rays=0", "specular.rays=0"});
    return settingsOf(assignments);
}

View viewFrom(const vec3& position, const vec3& toSun) {
    View view;
    view.camera.position = position;
    view.camera.target = {0, 0, 0};
    view.sun = builtin::sun(-glm::normalize(toSun), vec3(1.0F));
    return view;
}

Scene openGround() {
    return sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({10, 10}, {1, 1}, {1, 1}));
}

Scene groundWith(Mesh mesh, const vec3& position) {
    Scene scene = openGround();
    builtin::place(scene, "caster", 0, std::move(mesh), builtin::at(position));
    return scene;
}

/// On the ground, well inside (or outside) of the shadow of a bar along x with that half width and height: what it is.
struct GroundCount {
    unsigned shadowDark = 0;
    unsigned shadowLit = 0;
    unsigned openDark = 0;
    unsigned openLit = 0;
};

GroundCount countBar(const Pictures& p, const vec3& half, const vec3& toSun, float margin) {
    GroundCount count;
    const float reach = 2.0F * half.y * toSun.z / toSun.y;  // of the shadow, against the sun, along z
    const float from = std::min(0.0F, -reach) - half.z;
    const float to = std::max(0.0F, -reach) + half.z;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(0, 9, 0);
            if (at.y > 0.002F || std::abs(at.x) > half.x - 0.1F) {
                continue;
            }
            const bool dark = p.value("sun_visibility", x, y) == 0.0F;
            if (at.z > from + margin && at.z < to - margin) {
                ++(dark ? count.shadowDark : count.shadowLit);
            } else if (at.z < from - margin || at.z > to + margin) {
                ++(dark ? count.openDark : count.openLit);
            }
        }
    }
    return count;
}

TEST(Contact, ABarOnTheGroundThatACoarseMapMissesCastsItsShadow) {
    const vec3 half(1.0F, 0.02F, 0.02F);
    const Scene scene = groundWith(builtin::box(half), {0, half.y, 0});
    for (const vec3 sun : {vec3(0, 1, -1.5F), vec3(0.3F, 1, -0.8F), vec3(0, 1, 1.5F)}) {
        const vec3 toSun = glm::normalize(sun);
        const View view = viewFrom({0, 0.9F, 0.7F}, toSun);
        const auto count = [&](const char* resolution, const char* distance) {
            const Settings settings = with({"shadow.extent=10", resolution, distance});
            const Pictures p = render(scene, view, size, settings, {"sun_visibility", "depth"});
            return countBar(p, half, toSun, 0.008F);
        };
        for (const char* resolution : {"shadow.resolution=64", "shadow.resolution=256"}) {  // texels of 31 and 8 cm
            const GroundCount byMap = count(resolution, "contact.distance=0");
            EXPECT_LT(byMap.shadowDark, 3U) << "the map does see it";
            const GroundCount marched = count(resolution, "contact.distance=0.2");
            EXPECT_GT(marched.shadowDark, 100U) << resolution;
            EXPECT_EQ(marched.shadowLit, 0U) << resolution << ", sun at z = " << sun.z;
            EXPECT_EQ(marched.openDark, 0U) << resolution << ", sun at z = " << sun.z;
            EXPECT_GT(marched.openLit, 1000U);
        }
    }
    expectSilentValidation("contact shadows");
}

TEST(Contact, OpenGroundIsFullyLitAtEverySunHeightAboveFiveDegrees) {
    const Scene scene = openGround();
    for (const float degrees : {5.0F, 10.0F, 20.0F, 45.0F, 70.0F, 90.0F}) {
        const float a = glm::radians(degrees);
        for (const float turn : {0.0F, 2.0F, 4.0F}) {
            const vec3 toSun(std::cos(a) * std::cos(turn), std::sin(a), std::cos(a) * std::sin(turn));
            for (const char* thickness : {"contact.thickness=0.02", "contact.thickness=10"}) {
                const Pictures p = render(scene, viewFrom({0, 1.5F, 7}, toSun), size,
                                          with({"contact.distance=1", thickness}), {"sun_visibility"});
                EXPECT_EQ(rangeOf(p.images.at("sun_visibility")).min, 1.0F) << degrees << " degrees, " << thickness;
            }
        }
    }
}

TEST(Contact, ASphereDoesNotShadowItsLitSide) {
    const vec3 toSun = glm::normalize(vec3(0.3F, 1.0F, 0.5F));
    const Scene scene = groundWith(builtin::sphere(1.0F, 64), {0, 1, 0});
    for (const char* filter : {"shadow.filter=hard", "shadow.filter=pcss"}) {
        const Pictures p = render(scene, viewFrom({0, 5, 7}, toSun), size, with({"contact.distance=1", filter}),
                                  {"sun_visibility", "depth", "normal"});
        unsigned lit = 0;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                const vec3 n = p.color("normal", x, y);
                if (p.hasSurface(x, y) && p.position(x, y).y > 0.1F && glm::dot(n, toSun) > 0.15F) {
                    EXPECT_EQ(p.value("sun_visibility", x, y), 1.0F) << filter << ": " << x << ", " << y;
                    ++lit;
                }
            }
        }
        EXPECT_GT(lit, 200U);
    }
}

// The box blocks no sunlight on those sides, but on the screen its walls are beside each ray.
TEST(Contact, TheGroundBeforeWallsThatTheSunShinesOnGetsNoDarkerThanByTheMap) {
    const vec3 toSun = glm::normalize(vec3(-0.4F, 0.9F, 0.2F));
    const Scene scene = groundWith(builtin::box(vec3(0.5F)), {0, 0.5F, 0});
    for (const vec3 eye : {vec3(-1.0F, 1.5F, 3), vec3(-2.5F, 1, 1.5F), vec3(0.3F, 2, 3)}) {
        const View view = viewFrom(eye, toSun);
        const Pictures byMap = render(scene, view, size, with({}), {"sun_visibility", "depth"});
        const Pictures p = render(scene, view, size, with({"contact.distance=0.5"}), {"sun_visibility", "depth"});
        unsigned near = 0;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(0, 9, 0);
                const bool before = (at.x < -0.5F && at.z > -0.4F) || (at.z > 0.5F && at.x < 0.4F);
                if (at.y < 0.002F && before) {
                    EXPECT_EQ(p.value("sun_visibility", x, y), byMap.value("sun_visibility", x, y))
                        << at.x << ", " << at.z;
                    near += at.x > -0.6F && at.z < 0.6F ? 1 : 0;
                }
            }
        }
        EXPECT_GT(near, 20U);
    }
}

TEST(Contact, GroundThatIsSeenPastSomethingInTheForegroundStaysLit) {
    // A pole before the camera. Its shadow falls to the right, rays go to the left, behind it.
    const vec3 toSun = glm::normalize(vec3(-1.0F, 1.0F, 0.0F));
    const Scene scene = groundWith(builtin::box({0.04F, 0.5F, 0.04F}), {0, 0.5F, 3});
    View view = viewFrom({0, 1, 5}, toSun);
    const Pictures p = render(scene, view, size, with({"contact.distance=1"}), {"sun_visibility", "depth"});
    unsigned behind = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(0, 9, 0);
            if (at.y < 0.002F && at.z < 2.9F) {
                EXPECT_EQ(p.value("sun_visibility", x, y), 1.0F) << at.x << ", " << at.z;
                behind += at.z > 0.0F && at.x > 0.0F && at.x < 0.5F ? 1 : 0;
            }
        }
    }
    EXPECT_GT(behind, 100U);
}

TEST(Contact, IsOffByDefaultWhateverItsOtherSettingsAre) {
    const Scene scene = findBuiltinScene("colonnade")->make();
    const View view = defaultView(scene);
    const auto picture = [&](const std::vector<std::string>& assignments) {
        return render(scene, view, size, with(assignments), {"final"}).images.at("final").data;
    };
    const std::vector<float> plain = picture({});
    EXPECT_EQ(picture({"contact.thickness=10", "contact.max_steps=4096"}), plain);
    EXPECT_NE(picture({"contact.distance=0.25"}), plain);
}

View footOfAColumn(const Scene& colonnade) {
    View view = defaultView(colonnade);
    view.camera = *std::ranges::find(colonnade.cameras, "contact", &Camera::name);
    return view;
}

TEST(Contact, VisibilityIsTheMapsOrLess) {
    const Scene scene = findBuiltinScene("colonnade")->make();
    const View view = footOfAColumn(scene);
    const auto visibility = [&](const char* distance) {
        return render(scene, view, size, with({"shadow.resolution=256", distance}), {"sun_visibility"})
            .images.at("sun_visibility")
            .data;
    };
    const std::vector<float> byMap = visibility("contact.distance=0");
    const std::vector<float> both = visibility("contact.distance=0.25");
    unsigned darker = 0;
    for (size_t i = 0; i < byMap.size(); ++i) {
        EXPECT_LE(both[i], byMap[i]) << i;
        darker += both[i] < byMap[i] ? 1 : 0;
    }
    EXPECT_GT(darker, 20U);
}

TEST(Contact, BringsACoarseMapNearerToTheTruth) {
    const Scene scene = findBuiltinScene("colonnade")->make();
    const View view = footOfAColumn(scene);
    const ReferencePicture truth =
        traceReference(scene, view, size, {.bounces = 0, .samples = 64, .filter = PixelFilter::center});
    const auto differs = [&](const char* distance) {
        const Pictures p = render(scene, view, size, with({"shadow.resolution=256", distance}), {"sun_visibility"});
        return compareImages(p.images.at("sun_visibility"), truth.sunVisibility, {}).difference;
    };
    const Difference byMap = differs("contact.distance=0");
    const Difference both = differs("contact.distance=0.25");
    RecordProperty("relative_mse_by_map", std::to_string(byMap.relativeMse));
    RecordProperty("relative_mse", std::to_string(both.relativeMse));
    RecordProperty("flip_by_map", std::to_string(byMap.flip));
    RecordProperty("flip", std::to_string(both.flip));
    EXPECT_LT(both.relativeMse, 0.95 * byMap.relativeMse);
    EXPECT_LT(both.flip, byMap.flip);
}

}  // namespace
}  // namespace reflet::test::contact_test
