// glTF materials, textures and images.
#include "base/error.h"
#include "gltf_builder.h"
#include "scene/opacity.h"

#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

namespace reflet::test::gltf_material_test {
namespace {

using nlohmann::json;

/// A triangle with this material.
GltfBuilder withMaterial(const json& material) {
    GltfBuilder b = triangle();
    b.document["meshes"][0]["primitives"][0]["material"] = b.add("materials", material);
    return b;
}

Material materialOf(GltfBuilder builder) {
    return load(std::move(builder)).scene.materials.at(0);
}

TEST(GltfMaterial, WithoutOneThePrimitiveHasTheDefault) {
    const Scene scene = load(triangle()).scene;
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].baseColor, vec4(1));
    EXPECT_EQ(scene.materials[0].metallic, 1.0F);
    EXPECT_EQ(scene.materials[0].roughness, 1.0F);
    EXPECT_EQ(scene.materials[0].alphaCutoff, 0.0F);
    EXPECT_FALSE(scene.materials[0].doubleSided);
    EXPECT_LT(scene.materials[0].baseColorTexture.image, 0);
}

TEST(GltfMaterial, FactorsAreRead) {
    const Material m = materialOf(withMaterial(
        {{"name", "paint"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}},
         {"doubleSided", true}}));
    EXPECT_EQ(m.name, "paint");
    EXPECT_EQ(m.baseColor, vec4(0.5, 0.25, 0.125, 0.75));
    EXPECT_EQ(m.metallic, 0.5F);
    EXPECT_EQ(m.roughness, 0.25F);
    EXPECT_EQ(m.emissive, vec3(8, 4, 0));
    EXPECT_TRUE(m.doubleSided);
}

TEST(GltfMaterial, AMaterialThatShowsACameraEmitsNothingElse) {
    const Material m = materialOf(withMaterial({{"emissiveFactor", {1, 1, 1}}, {"extras", {{"camera", "door"}}}}));
    EXPECT_EQ(m.camera, "door");
    EXPECT_EQ(m.emissive, vec3(0));
    EXPECT_EQ(materialOf(withMaterial({{"extras", {{"other", 1}}}})).camera, "");
    EXPECT_EQ(materialOf(withMaterial({{"extras", 7}})).camera, "");
}

TEST(GltfMaterial, MaskHasItsCutoff) {
    EXPECT_NEAR(materialOf(withMaterial({{"alphaMode", "MASK"}})).alphaCutoff, 0.5F, 0.0011F);
    EXPECT_NEAR(materialOf(withMaterial({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}})).alphaCutoff, 0.25F, 0.0011F);
    EXPECT_EQ(materialOf(withMaterial({{"alphaMode", "OPAQUE"}, {"alphaCutoff", 0.25}})).alphaCutoff, 0.0F);
    EXPECT_FALSE(materialOf(withMaterial({{"alphaMode", "MASK"}})).blended);
}

json blendedWith(const json& factor) {
    return {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", factor}}}};
}

TEST(GltfMaterial, BlendIsBlendedUnlessItsAlphaIsOneEverywhere) {
    const Loaded glass = load(withMaterial(blendedWith({1, 1, 1, 0.5})));
    EXPECT_TRUE(glass.scene.materials.at(0).blended);
    EXPECT_EQ(glass.scene.materials.at(0).alphaCutoff, blendCutoff);
    EXPECT_TRUE(glass.warnings.empty());
    EXPECT_FALSE(materialOf(withMaterial({{"alphaMode", "BLEND"}})).blended);
    EXPECT_EQ(materialOf(withMaterial({{"alphaMode", "BLEND"}})).alphaCutoff, 0.0F);
    for (const uint8_t alpha : {uint8_t(255), uint8_t(254)}) {
        GltfBuilder b = triangle();
        json material = blendedWith({1, 1, 1, 1});
        material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", b.addTexture({9, 9, 9, alpha})}};
        b.document["meshes"][0]["primitives"][0]["material"] = b.add("materials", material);
        EXPECT_EQ(materialOf(std::move(b)).blended, alpha < 255);
    }
}

TEST(GltfMaterial, BlendFollowsTheAlphaOfAnyMeshsVertices) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].blended = scene.materials[1].blended = true;
    scene.materials[0].alphaCutoff = scene.materials[1].alphaCutoff = blendCutoff;
    scene.meshes.resize(3);
    for (size_t i = 0; i < 3; ++i) {
        scene.meshes[i].attributes.resize(3);
        scene.meshes[i].material = i < 2 ? 0 : 1;
    }
    scene.meshes[1].attributes[2].color.a = 65534;
    makeOpaqueWhereAlphaIsOne(scene);
    EXPECT_TRUE(scene.materials[0].blended);
    EXPECT_FALSE(scene.materials[1].blended);
}

TEST(GltfMaterial, EverySlotHasItsTextureItsUvSetAndItsFactor) {
    GltfBuilder b = triangle();
    const auto slot = [&](uint8_t value, int uvSet) {
        return json{{"index", b.addTexture({value, 0, 0, 255})}, {"texCoord", uvSet}};
    };
    json normal = slot(3, 1);
    normal["scale"] = 0.5;
    json occlusion = slot(4, 1);
    occlusion["strength"] = 0.25;
    b.document["meshes"][0]["primitives"][0]["material"] =
        b.add("materials",
              {{"pbrMetallicRoughness", {{"baseColorTexture", slot(1, 0)}, {"metallicRoughnessTexture", slot(2, 1)}}},
               {"normalTexture", normal},
               {"occlusionTexture", occlusion},
               {"emissiveTexture", slot(5, 0)}});
    const Scene scene = load(std::move(b)).scene;
    const Material& m = scene.materials.at(0);
    const auto expectSlot = [&](const TextureSlot& actual, uint8_t value, uint32_t uvSet) {
        ASSERT_GE(actual.image, 0);
        EXPECT_EQ(scene.images.at(static_cast<size_t>(actual.image)).rgba.at(0), value);
        EXPECT_EQ(actual.uvSet, uvSet);
        EXPECT_EQ(actual.sampler, -1);
        EXPECT_EQ(actual.uvTransform[0], vec3(1, 0, 0));
    };
    expectSlot(m.baseColorTexture, 1, 0);
    expectSlot(m.metallicRoughnessTexture, 2, 1);
    expectSlot(m.normalTexture, 3, 1);
    expectSlot(m.occlusionTexture, 4, 1);
    expectSlot(m.emissiveTexture, 5, 0);
    EXPECT_EQ(m.normalScale, 0.5F);
    EXPECT_EQ(m.occlusionStrength, 0.25F);
}

GltfBuilder withBaseColor(GltfBuilder b, const json& texture) {
    b.document["meshes"][0]["primitives"][0]["material"] =
        b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}});
    return b;
}

TextureSlot transformed(const json& transform) {
    GltfBuilder b = triangle();
    const int texture = b.addTexture({1, 2, 3, 4});
    const json extension = {{"KHR_texture_transform", transform}};
    return materialOf(withBaseColor(std::move(b), {{"index", texture}, {"extensions", extension}})).baseColorTexture;
}

vec2 apply(const TextureSlot& slot, vec2 uv) {
    return {glm::dot(slot.uvTransform[0], vec3(uv, 1)), glm::dot(slot.uvTransform[1], vec3(uv, 1))};
}

TEST(GltfMaterial, TheTextureTransformScalesThenTurnsThenMoves) {
    EXPECT_EQ(apply(transformed({{"offset", {0.5, 0.25}}, {"scale", {2, 3}}}), {1, 1}), vec2(2.5, 3.25));
    // The example of the extension's specification: a quarter turn that shows the lower left quarter of the image.
    const TextureSlot slot = transformed({{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}});
    EXPECT_NEAR(glm::distance(apply(slot, {0, 0}), vec2(0, 1)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(apply(slot, {1, 0}), vec2(0, 0.5)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(apply(slot, {0, 1}), vec2(0.5, 1)), 0, 1e-6);
    const TextureSlot uneven = transformed({{"rotation", 1.57079632679}, {"scale", {2, 3}}});
    EXPECT_NEAR(glm::distance(apply(uneven, {1, 1}), vec2(3, -2)), 0, 1e-6);
}

TEST(GltfMaterial, TheTextureTransformOverridesTheUvSet) {
    EXPECT_EQ(transformed({{"texCoord", 1}}).uvSet, 1U);
    EXPECT_EQ(transformed({{"offset", {0, 0}}}).uvSet, 0U);
}

TEST(GltfMaterial, SamplersAreRead) {
    const auto samplerOf = [](const json& sampler) {
        GltfBuilder b = triangle();
        const int texture = b.addTexture({1, 2, 3, 4});
        b.document["textures"][0]["sampler"] = b.add("samplers", sampler);
        const Scene scene = load(withBaseColor(std::move(b), {{"index", texture}})).scene;
        EXPECT_EQ(scene.materials.at(0).baseColorTexture.sampler, 0);
        return scene.samplers.at(0);
    };
    EXPECT_EQ(samplerOf(json::object()), Sampler{});
    EXPECT_EQ(samplerOf({{"wrapS", 33071}, {"wrapT", 33648}}), (Sampler{.wrapU = Wrap::clamp, .wrapV = Wrap::mirror}));
    EXPECT_EQ(samplerOf({{"magFilter", 9728}}), Sampler{.magLinear = false});
    EXPECT_EQ(samplerOf({{"minFilter", 9728}}), (Sampler{.minLinear = false, .mips = false, .mipLinear = false}));
    EXPECT_EQ(samplerOf({{"minFilter", 9729}}), (Sampler{.mips = false, .mipLinear = false}));
    EXPECT_EQ(samplerOf({{"minFilter", 9984}}), (Sampler{.minLinear = false, .mipLinear = false}));
    EXPECT_EQ(samplerOf({{"minFilter", 9985}}), (Sampler{.mipLinear = false}));
    EXPECT_EQ(samplerOf({{"minFilter", 9986}}), (Sampler{.minLinear = false}));
    EXPECT_EQ(samplerOf({{"minFilter", 9987}}), Sampler{});
}

TEST(GltfMaterial, TexturesOfOneImageShareIt) {
    GltfBuilder b = triangle();
    const int texture = b.addTexture({1, 2, 3, 4});
    const int other = b.add("textures", {{"source", 0}});
    b.document["meshes"][0]["primitives"][0]["material"] =
        b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}},
                            {"emissiveTexture", {{"index", other}}}});
    const Scene scene = load(std::move(b)).scene;
    ASSERT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.materials[0].baseColorTexture.image, 0);
    EXPECT_EQ(scene.materials[0].emissiveTexture.image, 0);
    EXPECT_EQ(scene.images[0].width, 2U);
    EXPECT_EQ(scene.images[0].height, 2U);
    EXPECT_EQ(scene.images[0].rgba, (std::vector<uint8_t>{1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4}));
}

TEST(GltfMaterial, AnImageThatNoUsedMaterialShowsIsNotRead) {
    GltfBuilder b = triangle();
    b.add("images", {{"uri", "gone.png"}});
    b.add("textures", {{"source", 0}});
    b.add("materials", {{"normalTexture", {{"index", 0}}}});
    EXPECT_TRUE(load(std::move(b)).scene.images.empty());
}

TEST(GltfMaterial, ATextureWithoutAnImageIsLeftOutWithAWarning) {
    GltfBuilder b = triangle();
    const int texture = b.add("textures", json::object());
    const Loaded loaded = load(withBaseColor(std::move(b), {{"index", texture}}));
    EXPECT_LT(loaded.scene.materials[0].baseColorTexture.image, 0);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("textures[0]: the texture will be left out: it has no source image"),
              std::string::npos);
}

/// Loads a triangle with an image of this URI, next to the files that `prepare` writes.
TextureImage imageFrom(const std::string& uri, const std::function<void(const std::filesystem::path&)>& prepare) {
    const auto folder = testFolder();
    prepare(folder);
    GltfBuilder b = triangle();
    b.add("images", {{"uri", uri}});
    const int texture = b.add("textures", {{"source", 0}});
    return load(withBaseColor(std::move(b), {{"index", texture}}).writeGltf(folder / "scene.gltf")).scene.images.at(0);
}

std::string pngBytes(std::array<uint8_t, 4> color) {
    const std::vector<uint8_t> png = pngOf(3, 2, color);
    return {png.begin(), png.end()};
}

TEST(GltfUri, ImagesMayBeFilesDataUrisAndPercentEncodedNames) {
    const auto red = [](uint8_t value) { return pngBytes({value, 0, 0, 255}); };
    const TextureImage file = imageFrom("a.png", [&](const auto& folder) { writeBytes(folder / "a.png", red(1)); });
    EXPECT_EQ(file.rgba.at(0), 1);
    EXPECT_EQ(file.name, "a.png");
    EXPECT_EQ(file.width, 3U);
    EXPECT_EQ(file.height, 2U);
    EXPECT_EQ(imageFrom("my%20im%C3%A4ge.png",
                        [&](const auto& folder) { writeBytes(folder / "my im\xC3\xA4ge.png", red(2)); })
                  .rgba.at(0),
              2);
    EXPECT_EQ(
        imageFrom("a+b%zz.png", [&](const auto& folder) { writeBytes(folder / "a+b%zz.png", red(3)); }).rgba.at(0), 3);
    EXPECT_EQ(imageFrom("sub/./a..b.png",
                        [&](const auto& folder) {
                            std::filesystem::create_directories(folder / "sub");
                            writeBytes(folder / "sub" / "a..b.png", red(4));
                        })
                  .rgba.at(0),
              4);
    EXPECT_EQ(imageFrom("data:image/png;base64," + base64(pngOf(1, 1, {5, 0, 0, 255})), [](const auto&) {}).rgba.at(0),
              5);
}

TEST(GltfUri, ImagesMayBeJpeg) {
    const std::vector<uint8_t> grey(384, 200);
    std::string jpeg;
    stbi_write_jpg_to_func(
        [](void* context, void* data, int size) {
            static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<size_t>(size));
        },
        &jpeg, 16, 8, 3, grey.data(), 90);
    const TextureImage image = imageFrom("a.jpg", [&](const auto& folder) { writeBytes(folder / "a.jpg", jpeg); });
    EXPECT_EQ(image.width, 16U);
    EXPECT_EQ(image.height, 8U);
    EXPECT_NEAR(image.rgba.at(0), 200, 2);
    EXPECT_EQ(image.rgba.at(3), 255);
}

TEST(GltfUri, BuffersMayBeFilesChunksAndDataUris) {
    const auto folder = testFolder();
    GltfBuilder b = triangle();
    writeBytes(folder / "the buffer.bin", std::string(b.bin.begin(), b.bin.end()) + "padding");
    GltfBuilder external = b;
    external.add("buffers", {{"byteLength", b.bin.size()}, {"uri", "the%20buffer.bin"}});
    for (const auto& path : {external.writeGltf(folder / "a.gltf"), GltfBuilder(b).writeGltf(folder / "b.gltf"),
                             GltfBuilder(b).writeGlb(folder / "c.glb")}) {
        const Scene scene = load(path).scene;
        EXPECT_EQ(scene.meshes.at(0).positions.at(1), vec3(1, 0, 0));
        EXPECT_EQ(scene.name, "first");
    }
}

TEST(GltfUri, ABufferDataUriNeedNotBeBase64) {
    GltfBuilder b = triangle();
    b.document["accessors"][0]["count"] = 3;
    std::string escaped = "data:,";
    for (const uint8_t byte : b.bin) {
        escaped += fmt::format("%{:02x}", byte);
    }
    b.add("buffers", {{"byteLength", b.bin.size()}, {"uri", escaped}});
    EXPECT_EQ(load(std::move(b)).scene.meshes.at(0).positions.at(2), vec3(0, 1, 0));
}

}  // namespace
}  // namespace reflet::test::gltf_material_test
