// Surfaces at ray hits against the G-buffer of the same camera: textures, samplers, transforms, normal maps.
#include "pass/scene_surfaces_test.h"

#include "pass/harness.h"
#include "pass/test_shaders.h"
#include "renderer/trace_scene/trace_scene.h"
#include "scene/builtin.h"
#include "scene/builtin/patterns.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace reflet::test::scene_surfaces_test {
namespace {

constexpr uvec2 size(240, 160);

struct Seen {
    std::vector<SurfaceOfPixel> rays;
    Pictures pictures;
};

// How far two vectors are apart, at most of their components.
float apart(const vec3& a, const vec3& b) {
    const vec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

class SceneSurfacesTest : public DeviceTest {
protected:
    static Seen look(const Scene& scene, const View& view, const Settings& settings, float widthPerPixel,
                     uint32_t textureSize = 1024) {
        addPassTestShaders(device());
        const auto silent = [](const std::string&) {};
        const GpuScene onDevice(device(), scene, silent);
        const TracedScene traced{SceneRays(device(), scene, RayMethod::traversal),
                                 SceneSurfaces(device(), scene, onDevice, textureSize, silent)};
        const gpu::Buffer outputs(device(), sizeof(SurfaceOfPixel) * size.x * size.y,
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryUse::readback, "outputs");
        frame().begin();
        gpu::ComputePass pass = frame().compute("surfaces", "scene_surfaces_test.comp");
        traced.rays.bind(pass);
        traced.surfaces.bind(pass);
        pass.write("outputs", outputs.view())
            .params(SceneSurfacesTestParams{makeViewParams(view.camera, size, 0, 0), widthPerPixel})
            .dispatch(size);
        frame().submit();
        frame().wait();
        showToHost();
        Seen seen{std::vector<SurfaceOfPixel>(size_t(size.x) * size.y),
                  render(scene, view, size, settings,
                         {"albedo", "normal", "roughness", "metallic", "occlusion", "emissive", "depth"})};
        std::memcpy(seen.rays.data(), outputs.bytes().data(), outputs.bytes().size());
        return seen;
    }

    /// Fractions of the pixels at which ray and G-buffer agree, within the rounding of the G-buffer's formats.
    struct Agreement {
        double depth = 0.0;
        double color = 0.0;
        double normal = 0.0;
        double rest = 0.0;
    };

    static Agreement compare(const Seen& seen, float tolerance) {
        Agreement share;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                const SurfaceOfPixel& ray = seen.rays[size_t(y) * size.x + x];
                const Pictures& p = seen.pictures;
                share.depth += std::abs(ray.distance - p.value("depth", x, y)) < 1e-3F ? 1 : 0;
                share.color += apart(ray.baseColor, p.color("albedo", x, y)) < tolerance ? 1 : 0;
                share.normal += apart(ray.normal, p.color("normal", x, y)) < tolerance ? 1 : 0;
                share.rest += apart({ray.roughness, ray.metallic, ray.occlusion},
                                    {p.value("roughness", x, y), p.value("metallic", x, y),
                                     p.hasSurface(x, y) ? p.value("occlusion", x, y) : 0.0F}) < tolerance &&
                                      apart(ray.emissive, p.color("emissive", x, y)) < 2.0F * tolerance
                                  ? 1
                                  : 0;
            }
        }
        const double all = double(size.x) * size.y;
        return {share.depth / all, share.color / all, share.normal / all, share.rest / all};
    }
};

// Smooth all over, so that a texel to the left or right is seen, and different in its four channels.
TextureImage gradient(const char* name, uint32_t width, uint32_t height, float turns) {
    TextureImage image{name, width, height, {}};
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(width);
            const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(height);
            const auto byte = [](float t) { return static_cast<uint8_t>(127.5F + 100.0F * std::sin(t)); };
            image.rgba.insert(image.rgba.end(), {byte(turns * u), byte(turns * v + 1.0F), byte(turns * (u + v)), 255});
        }
    }
    return image;
}

// A wall of tiles, each with another sampler, transform, image size and uv set.
Scene tiles() {
    Scene scene;
    int number = 0;
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        for (const bool linear : {true, false}) {
            Sampler sampler{.wrapU = wrap, .wrapV = wrap, .magLinear = linear};
            Material m = lambertMaterial({0.9F, 0.7F, 0.8F});
            m.metallic = 0.8F;
            m.roughness = 0.9F;
            m.emissive = vec3(0.5F);
            m.occlusionStrength = 0.7F;
            m.normalScale = 0.6F;
            const uint32_t side = 16U << static_cast<unsigned>(number % 3);
            m.baseColorTexture = builtin::addTexture(scene, gradient("color", side, side, 9.0F), sampler);
            m.metallicRoughnessTexture = builtin::addTexture(scene, gradient("data", 32, 16, 5.0F), sampler);
            m.occlusionTexture = m.metallicRoughnessTexture;
            m.emissiveTexture = builtin::addTexture(scene, gradient("glow", 8, 8, 3.0F), sampler);
            m.normalTexture = builtin::addTexture(
                scene,
                builtin::normalMap("bumps", 32, 1.0F,
                                   [](const vec2& uv) { return 0.05F * std::sin(6.2831853F * (uv.x + uv.y)); }),
                sampler);
            m.baseColorTexture.uvTransform = {vec3(1.3F, 0.4F, -0.2F), vec3(-0.5F, 1.1F, 0.3F)};
            m.emissiveTexture.uvSet = 1;
            Mesh mesh = builtin::box({0.4F, 0.4F, 0.2F});
            for (VertexAttributes& v : mesh.attributes) {
                v.uv1 = vec2(2.5F) * vec2(v.uv0.y, v.uv0.x) - 0.6F;
                v.color = builtin::vertexColor({1.0F - 0.4F * v.uv0.x, 1.0F, 0.5F + 0.5F * v.uv0.y});
            }
            const mat4 place = builtin::at({static_cast<float>(number % 3) - 1.0F, number < 3 ? 0.5F : -0.5F, 0}) *
                               builtin::turned(10.0F * static_cast<float>(number - 2), {0.3F, 1, 0.2F});
            // One is mirrored, one is stretched.
            const vec3 scale = number == 1 ? vec3(-1, 1, 1) : number == 4 ? vec3(1, 0.7F, 2) : vec3(1);
            builtin::place(scene, "tile", builtin::addMaterial(scene, m), std::move(mesh),
                           place * glm::scale(mat4(1.0F), scale));
            ++number;
        }
    }
    return scene;
}

View front(float distance) {
    View view;
    view.camera = builtin::camera("eye", {0.2F, 0.1F, distance}, {0, 0, 0}, 40.0F);
    view.sun = builtin::sun(glm::normalize(vec3(-0.3F, -0.5F, -1.0F)), vec3(2.0F));
    return view;
}

const Settings& fullDetail() {
    static const Settings settings =
        settingsOf({"materials.mips=off", "materials.anisotropy=1", "diffuse.rays=0", "specular.rays=0"});
    return settings;
}

TEST_F(SceneSurfacesTest, AreThoseOfTheGBufferWhateverTheSamplerTheTransformTheUvSetAndThePlace) {
    const Agreement same = compare(look(tiles(), front(3.2F), fullDetail(), 0.0F), 0.012F);
    EXPECT_GT(same.depth, 0.99);
    EXPECT_GT(same.color, 0.985);
    EXPECT_GT(same.normal, 0.985);
    EXPECT_GT(same.rest, 0.96);  // their image has another shape than its layer, and is stretched
    std::printf("same: depth %.4f, colour %.4f, normal %.4f, rest %.4f\n", same.depth, same.color, same.normal,
                same.rest);
}

class SceneSurfacesOfBuiltins : public SceneSurfacesTest, public testing::WithParamInterface<const char*> {};

TEST_P(SceneSurfacesOfBuiltins, AreThoseOfTheGBuffer) {
    const Scene scene = findBuiltinScene(GetParam())->make();
    const Agreement same = compare(look(scene, defaultView(scene), fullDetail(), 0.0F, 4096), 0.012F);
    EXPECT_GT(same.depth, 0.97);
    EXPECT_GT(same.color, 0.96);
    EXPECT_GT(same.normal, 0.97);
    EXPECT_GT(same.rest, 0.97);
    std::printf("%s: depth %.4f, colour %.4f, normal %.4f, rest %.4f\n", GetParam(), same.depth, same.color,
                same.normal, same.rest);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneSurfacesOfBuiltins,
                         testing::Values("cubes", "cornell", "cave", "gloss", "mirror-hall", "colonnade"),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

TEST_F(SceneSurfacesTest, AreBlurredAsTheGBuffersAreWhereTexturesAreSeenFromFarAway) {
    Scene scene;
    Material m = lambertMaterial(vec3(1.0F));
    m.baseColorTexture = builtin::addTexture(scene, gradient("stripes", 1024, 1024, 1608.5F));
    builtin::place(scene, "wall", builtin::addMaterial(scene, m), builtin::patch({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}));
    const Settings mips = settingsOf({"materials.anisotropy=1", "diffuse.rays=0", "specular.rays=0"});
    const Agreement same = compare(look(scene, front(8.0F), mips, 1.0F), 0.05F);
    EXPECT_GT(same.color, 0.95);
    const Agreement sharp = compare(look(scene, front(8.0F), mips, 0.0F), 0.05F);
    EXPECT_LT(sharp.color, 0.8);
}

TEST_F(SceneSurfacesTest, ShowWhatLiesBehindWhatIsCutOut) {
    Scene scene;
    builtin::Canvas canvas("holes", 64, 64, 0xFFFFFF);
    canvas.disc({32, 32}, 20, 0xFFFFFF, 0);
    Material m = lambertMaterial({0.2F, 0.8F, 0.3F});
    m.baseColorTexture = builtin::addTexture(scene, canvas.finish());
    m.alphaCutoff = 0.5F;
    m.doubleSided = true;
    builtin::place(scene, "sieve", builtin::addMaterial(scene, m),
                   builtin::patch({{0, 0, 0.5F}, {1.5F, 0, 0}, {0, 1.5F, 0}, {1, 1}, {4, 4}}));
    builtin::place(scene, "wall", builtin::addMaterial(scene, lambertMaterial({0.9F, 0.1F, 0.1F})),
                   builtin::patch({{0, 0, -0.5F}, {3, 0, 0}, {0, 3, 0}}));
    const Seen seen = look(scene, front(3.2F), fullDetail(), 0.0F);
    const Agreement same = compare(seen, 0.012F);
    EXPECT_GT(same.depth, 0.985);
    EXPECT_GT(same.color, 0.985);
    const auto red = std::ranges::count_if(seen.rays, [](const SurfaceOfPixel& s) { return s.baseColor.x > 0.8F; });
    EXPECT_GT(red, 5000);
    EXPECT_LT(red, 25000);
}

TEST_F(SceneSurfacesTest, AreDownsampledWithAWarningWhereImagesAreLargerThanTheLimit) {
    const Scene scene = tiles();
    std::vector<std::string> said;
    const auto hear = [&](const std::string& text) { said.push_back(text); };
    const GpuScene onDevice(device(), scene, hear);
    const SceneSurfaces surfaces(device(), scene, onDevice, 16, hear);
    ASSERT_EQ(said.size(), 2U);  // of colours, of data
    EXPECT_NE(said[0].find("shrunk to 16 texels for ray hits: trace_scene.texture_size is the limit"),
              std::string::npos)
        << said[0];
    const Agreement same = compare(look(scene, front(3.2F), fullDetail(), 0.0F, 16), 0.15F);
    EXPECT_GT(same.color, 0.9);
}

}  // namespace
}  // namespace reflet::test::scene_surfaces_test
