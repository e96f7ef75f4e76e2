// Hard shadows: the position of their edges, and no self-shadowing.
#include "pass/harness.h"
#include "renderer/draw_shadows/shadow_maps.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::shadow_test {
namespace {

constexpr uvec2 size(200, 112);
const std::vector<std::string> direct{"diffuse.rays=0", "specular.rays=0", "shadow.filter=hard"};

View viewOfGround(const vec3& toSun) {
    View view;
    view.camera.position = {0, 5, 7};
    view.camera.target = {0, 0, 0};
    view.sun = builtin::sun(-glm::normalize(toSun), vec3(1.0F));
    return view;
}

Scene groundWith(Mesh mesh, const mat4& objectToWorld) {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({10, 10}, {1, 1}, {1, 1}));
    builtin::place(scene, "caster", 0, std::move(mesh), objectToWorld);
    return scene;
}

TEST(Shadow, EdgeOfAFloatingSlabLiesWhereTheSunProjectsIt) {
    const vec3 toSun = glm::normalize(vec3(0.3F, 1.0F, 0.1F));
    const vec3 half(1.0F, 0.02F, 1.0F);
    const float height = 2.0F;
    const Scene scene = groundWith(builtin::box(half), builtin::at({0, height, 0}));
    const View view = viewOfGround(toSun);
    const Pictures p = render(scene, view, size, settingsOf(direct), {"sun_visibility", "depth"});
    const ShadowMapParams map =
        fitSunShadow(p.view.clipToWorld, scene.bounds(), view.sun.direction, ShadowSettings{}.resolution);
    const float tolerance = 2.0F * map.texelSize;
    unsigned dark = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y)) {
                continue;
            }
            const vec3 at = p.position(x, y);
            if (std::abs(at.y) > 0.01F) {
                continue;  // the slab itself
            }
            // Distance inside the shadows of the upper and the lower face: their union is the slab's shadow.
            const auto inside = [&](float faceHeight) {
                const vec3 through = at + toSun * (faceHeight / toSun.y);
                return std::min(half.x - std::abs(through.x), half.z - std::abs(through.z));
            };
            const float depth = std::max(inside(height - half.y), inside(height + half.y));
            if (depth > tolerance) {
                EXPECT_EQ(p.value("sun_visibility", x, y), 0.0F) << at.x << ", " << at.z;
                ++dark;
            } else if (depth < -tolerance - 2.0F * half.y) {
                EXPECT_EQ(p.value("sun_visibility", x, y), 1.0F) << at.x << ", " << at.z;
            }
        }
    }
    EXPECT_GT(dark, 200U);
    expectSilentValidation("shadows");
}

TEST(Shadow, BeginsAtTheFootOfABoxOnTheGround) {
    const vec3 toSun = glm::normalize(vec3(0.0F, 1.0F, -1.0F));  // from behind: the shadow falls toward the camera
    const Scene scene = groundWith(builtin::box(vec3(1.0F)), builtin::at({0, 1, 0}));
    const Pictures p = render(scene, viewOfGround(toSun), size, settingsOf(direct), {"sun_visibility", "depth"});
    unsigned seen = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y)) {
                continue;
            }
            const vec3 at = p.position(x, y);
            const bool beforeTheBox = at.y < 0.01F && std::abs(at.x) < 0.9F && at.z > 1.005F && at.z < 2.9F;
            if (beforeTheBox) {
                EXPECT_EQ(p.value("sun_visibility", x, y), 0.0F) << "light under the box at z = " << at.z;
                ++seen;
            }
        }
    }
    EXPECT_GT(seen, 200U);
}

TEST(Shadow, AClosedBoxIsBlackInside) {
    Material material = lambertMaterial(vec3(0.5F));
    material.doubleSided = true;
    View view;
    view.camera.position = {0.5F, 0.2F, 0.7F};
    view.camera.target = {-1, -0.5F, -1};
    view.sun = builtin::sun(glm::normalize(vec3(0.4F, -0.9F, -0.2F)), vec3(100.0F));
    const Pictures p =
        render(sceneOf(material, builtin::box(vec3(1.0F))), view, size, settingsOf(direct), {"direct", "depth"});
    EXPECT_GT(rangeOf(p.images.at("depth")).min, 0.0F) << "the camera looks at walls only";
    EXPECT_EQ(rangeOf(p.images.at("direct")).max, 0.0F);
}

TEST(Shadow, ACentimetreOfConstantBiasEndsSelfShadowingInAMapOfTenMetresAndNoneDoesNot) {
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({9, 9}, {1, 1}, {1, 1}));
    const View view = viewOfGround({0.5F, 1.0F, 0.2F});
    const auto darkShare = [&](const char* bias) {
        auto settings = direct;
        settings.insert(settings.end(), {"shadow.extent=10", "shadow.bias_kind=constant", bias});
        const Pictures p = render(scene, view, size, settingsOf(settings), {"sun_visibility"});
        const auto& data = p.images.at("sun_visibility").data;
        return static_cast<double>(std::ranges::count(data, 0.0F)) / static_cast<double>(data.size());
    };
    EXPECT_GT(darkShare("shadow.constant_bias=0"), 0.2);
    EXPECT_EQ(darkShare("shadow.constant_bias=0.01"), 0.0);
}

TEST(Shadow, OfAMapOfGivenExtentEndsThere) {
    // The sun at its height; two slabs, one over the origin and one wholly outside of the map.
    Scene scene = groundWith(builtin::box(vec3(1.0F, 0.02F, 1.0F)), builtin::at({0, 2, 0}));
    builtin::place(scene, "outside", 0, builtin::box(vec3(1.0F, 0.02F, 1.0F)), builtin::at({6, 2, 0}));
    View view = viewOfGround({0, 1, 0});
    view.camera.position = {3, 1.5F, 9};
    view.camera.target = {3, 0, 0};
    for (const char* kind : {"shadow.bias_kind=slope", "shadow.bias_kind=constant"}) {
        auto settings = direct;
        settings.insert(settings.end(), {"shadow.extent=4", kind});
        const Pictures p = render(scene, view, size, settingsOf(settings), {"sun_visibility", "depth"});
        unsigned dark = 0;
        unsigned lit = 0;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(0, 9, 0);
                if (std::abs(at.y) > 0.01F || std::abs(at.z) > 0.95F) {
                    continue;
                }
                const bool shadowed = std::abs(at.x) < 0.95F;
                if (shadowed || std::abs(at.x - 6.0F) < 0.95F) {
                    EXPECT_EQ(p.value("sun_visibility", x, y), shadowed ? 0.0F : 1.0F) << kind << ": " << at.x;
                    ++(shadowed ? dark : lit);
                }
            }
        }
        EXPECT_GT(std::min(dark, lit), 50U);
    }
}

TEST(Shadow, CutOutMaterialsCastOnlyWhatIsThere) {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({10, 10}, {1, 1}, {1, 1}));
    TextureImage image{"half", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}};  // left half there, right half cut out
    Sampler nearest;
    nearest.magLinear = nearest.minLinear = nearest.mips = false;
    nearest.wrapU = nearest.wrapV = Wrap::clamp;
    Material material = builtin::textured("cut out", builtin::addTexture(scene, image, nearest), 1.0F);
    material.alphaCutoff = 0.5F;
    builtin::place(scene, "sheet", builtin::addMaterial(scene, material), builtin::ground({1, 1}, {1, 1}, {1, 1}),
                   builtin::at({0, 1, 0}));
    View view = viewOfGround({0, 1, 0});
    view.camera.position = {0, 0.8F, 6};
    const Pictures p = render(scene, view, size, settingsOf(direct), {"sun_visibility", "depth"});
    unsigned dark = 0;
    unsigned lit = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y)) {
                continue;
            }
            const vec3 at = p.position(x, y);
            if (at.y < 0.01F && std::abs(at.z) < 0.9F && std::abs(at.x) > 0.05F && std::abs(at.x) < 0.95F) {
                EXPECT_EQ(p.value("sun_visibility", x, y), at.x < 0.0F ? 0.0F : 1.0F) << at.x << ", " << at.z;
                ++(at.x < 0.0F ? dark : lit);
            }
        }
    }
    EXPECT_GT(std::min(dark, lit), 20U);
}

}  // namespace
}  // namespace reflet::test::shadow_test
