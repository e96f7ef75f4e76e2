// Material extensions of glTF: unlit, ior, specular, variants.
#include "base/error.h"
#include "gltf_builder.h"

#include <gtest/gtest.h>

namespace reflet::test::gltf_extensions_test {
namespace {

using nlohmann::json;

GltfBuilder withExtension(const char* name, const json& extension) {
    GltfBuilder b = triangle();
    b.document["extensionsUsed"] = {name};
    b.document["extensionsRequired"] = {name};
    b.document["meshes"][0]["primitives"][0]["material"] =
        b.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}}},
                            {"emissiveFactor", {1, 0, 0}},
                            {"extensions", {{name, extension}}}});
    return b;
}

Material materialOf(GltfBuilder builder) {
    const Loaded loaded = load(std::move(builder));
    EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front();
    return loaded.scene.materials.at(0);
}

TEST(GltfExtensions, MaterialsWithoutThemAreLitAndReflectFourPercent) {
    const Material m = load(triangle()).scene.materials.at(0);
    EXPECT_FALSE(m.unlit);
    EXPECT_EQ(m.ior, 1.5F);
    EXPECT_EQ(m.specular, 1.0F);
    EXPECT_EQ(m.specularColor, vec3(1.0F));
    EXPECT_LT(m.specularTexture.image, 0);
    EXPECT_LT(m.specularColorTexture.image, 0);
}

TEST(GltfExtensions, ASceneOfUnlitMaterialsGetsNoSunAndOneOfBothDoes) {
    GltfBuilder b = withExtension("KHR_materials_unlit", json::object());
    const Scene unlit = load(b).scene;
    EXPECT_TRUE(unlit.materials.at(0).unlit);
    EXPECT_TRUE(isUnlit(unlit));
    EXPECT_EQ(defaultView(unlit).sun.irradiance, vec3(0.0F));
    EXPECT_FALSE(defaultView(unlit).hasDefaultSun);
    b.addPrimitive({{"attributes", {{"POSITION", 0}}}});
    const Scene both = load(b).scene;
    EXPECT_FALSE(isUnlit(both));
    EXPECT_TRUE(defaultView(both).hasDefaultSun);
    EXPECT_FALSE(isUnlit(Scene{}));
}

TEST(GltfExtensions, AMaterialThatShowsACameraIsNotUnlit) {
    GltfBuilder b = withExtension("KHR_materials_unlit", json::object());
    b.document["materials"][0]["extras"]["camera"] = "door";
    EXPECT_FALSE(materialOf(b).unlit);
}

TEST(GltfExtensions, IorIsReadAndMayBe0) {
    EXPECT_EQ(materialOf(withExtension("KHR_materials_ior", {{"ior", 2.25}})).ior, 2.25F);
    EXPECT_EQ(materialOf(withExtension("KHR_materials_ior", {{"ior", 0}})).ior, 0.0F);
    EXPECT_EQ(materialOf(withExtension("KHR_materials_ior", json::object())).ior, 1.5F);
    const Loaded below = load(withExtension("KHR_materials_ior", {{"ior", 0.5}}));
    EXPECT_EQ(below.scene.materials.at(0).ior, 1.5F);
    ASSERT_EQ(below.warnings.size(), 1U);
    EXPECT_NE(below.warnings[0].find("materials[0].extensions.KHR_materials_ior.ior: the surface will reflect as one "
                                     "of 1.5: 0.5 is neither 0 nor at least 1"),
              std::string::npos)
        << below.warnings[0];
}

TEST(GltfExtensions, SpecularHasItsFactorsAndTexturesWithTheirTransformAndUvSet) {
    GltfBuilder b = withExtension("KHR_materials_specular", json::object());
    const auto info = [&](uint8_t value, const json& transform) {
        return json{{"index", b.addTexture({value, 0, 0, 255})},
                    {"texCoord", 0},
                    {"extensions", {{"KHR_texture_transform", transform}}}};
    };
    json& specular = b.document["materials"][0]["extensions"]["KHR_materials_specular"];
    specular = {{"specularFactor", 0.5},
                {"specularColorFactor", {0, 1, 2}},
                {"specularTexture", info(1, {{"offset", {0.25, 0.5}}})},
                {"specularColorTexture", info(2, {{"texCoord", 1}, {"scale", {2, 3}}})}};
    const Scene scene = load(b).scene;
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.specular, 0.5F);
    EXPECT_EQ(m.specularColor, vec3(0, 1, 2));
    EXPECT_EQ(scene.images.at(static_cast<size_t>(m.specularTexture.image)).rgba.at(0), 1);
    EXPECT_EQ(m.specularTexture.uvSet, 0U);
    EXPECT_EQ(m.specularTexture.uvTransform[0], vec3(1, 0, 0.25F));
    EXPECT_EQ(m.specularTexture.uvTransform[1], vec3(0, 1, 0.5F));
    EXPECT_EQ(scene.images.at(static_cast<size_t>(m.specularColorTexture.image)).rgba.at(0), 2);
    EXPECT_EQ(m.specularColorTexture.uvSet, 1U);
    EXPECT_EQ(m.specularColorTexture.uvTransform[0], vec3(2, 0, 0));
    EXPECT_EQ(m.specularColorTexture.uvTransform[1], vec3(0, 3, 0));
}

// The texture of a slot has this red value.
void expectTexture(const Scene& scene, const TextureSlot& slot, uint8_t red) {
    ASSERT_GE(slot.image, 0);
    EXPECT_EQ(scene.images.at(static_cast<size_t>(slot.image)).rgba.at(0), red);
}

TEST(GltfExtensions, TransmissionAndVolumeAreRead) {
    GltfBuilder b = withExtension("KHR_materials_transmission", json::object());
    json& extensions = b.document["materials"][0]["extensions"];
    extensions["KHR_materials_transmission"] = {{"transmissionFactor", 0.75},
                                                {"transmissionTexture", {{"index", b.addTexture({1, 0, 0, 255})}}}};
    b.document["extensionsUsed"].push_back("KHR_materials_volume");
    extensions["KHR_materials_volume"] = {{"thicknessFactor", 0.5},
                                          {"thicknessTexture", {{"index", b.addTexture({2, 0, 0, 255})}}},
                                          {"attenuationDistance", 2},
                                          {"attenuationColor", {0.5, 0.25, 1}}};
    const Scene scene = load(b).scene;
    const Transmission& t = scene.materials.at(0).transmission;
    EXPECT_EQ(t.factor, 0.75F);
    EXPECT_EQ(t.thickness, 0.5F);
    EXPECT_EQ(t.attenuationDistance, 2.0F);
    EXPECT_EQ(t.attenuationColor, vec3(0.5F, 0.25F, 1.0F));
    expectTexture(scene, t.texture, 1);
    expectTexture(scene, t.thicknessTexture, 2);
}

TEST(GltfExtensions, GlassIsClearAndThinUnlessTheFileSaysElse) {
    const Transmission opaque = materialOf(withExtension("KHR_materials_transmission", json::object())).transmission;
    EXPECT_EQ(opaque.factor, 0.0F);
    const Transmission pane = load(withExtension("KHR_materials_transmission", {{"transmissionFactor", 1}}))
                                  .scene.materials.at(0)
                                  .transmission;
    EXPECT_EQ(pane.factor, 1.0F);
    EXPECT_EQ(pane.thickness, 0.0F);
    EXPECT_EQ(pane.attenuationColor, vec3(1.0F));
    EXPECT_EQ(pane.attenuationDistance, std::numeric_limits<float>::infinity());
    const Transmission volume =
        materialOf(withExtension("KHR_materials_volume", {{"thicknessFactor", 1}})).transmission;
    EXPECT_EQ(volume.factor, 0.0F) << "a volume without transmission is opaque";
    EXPECT_EQ(volume.thickness, 0.0F);
}

TEST(GltfExtensions, AnAttenuationDistanceOf0IsNone) {
    GltfBuilder b = withExtension("KHR_materials_transmission", {{"transmissionFactor", 1}});
    b.document["materials"][0]["extensions"]["KHR_materials_volume"] = {{"attenuationDistance", 0}};
    const Loaded loaded = load(b);
    EXPECT_EQ(loaded.scene.materials.at(0).transmission.attenuationDistance, std::numeric_limits<float>::infinity());
    ASSERT_FALSE(loaded.warnings.empty());
    EXPECT_NE(loaded.warnings.back().find("KHR_materials_volume.attenuationDistance: the glass will be clear"),
              std::string::npos)
        << loaded.warnings.back();
}

TEST(GltfExtensions, ClearcoatHasItsFactorsAndTextures) {
    GltfBuilder b = withExtension("KHR_materials_clearcoat", json::object());
    json& coat = b.document["materials"][0]["extensions"]["KHR_materials_clearcoat"];
    coat = {{"clearcoatFactor", 0.5},
            {"clearcoatRoughnessFactor", 0.25},
            {"clearcoatTexture", {{"index", b.addTexture({1, 0, 0, 255})}}},
            {"clearcoatRoughnessTexture", {{"index", b.addTexture({2, 0, 0, 255})}}},
            {"clearcoatNormalTexture", {{"index", b.addTexture({3, 0, 0, 255})}, {"scale", 0.75}}}};
    const Scene scene = load(b).scene;
    const Clearcoat& c = scene.materials.at(0).clearcoat;
    EXPECT_EQ(c.factor, 0.5F);
    EXPECT_EQ(c.roughness, 0.25F);
    EXPECT_EQ(c.normalScale, 0.75F);
    expectTexture(scene, c.texture, 1);
    expectTexture(scene, c.roughnessTexture, 2);
    expectTexture(scene, c.normalTexture, 3);
}

TEST(GltfExtensions, SheenHasItsFactorsAndTextures) {
    GltfBuilder b = withExtension("KHR_materials_sheen", json::object());
    b.document["materials"][0]["extensions"]["KHR_materials_sheen"] = {
        {"sheenColorFactor", {0.5, 0.25, 1}},
        {"sheenRoughnessFactor", 0.75},
        {"sheenColorTexture", {{"index", b.addTexture({1, 0, 0, 255})}}},
        {"sheenRoughnessTexture", {{"index", b.addTexture({2, 0, 0, 255})}}}};
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    const Sheen& s = loaded.scene.materials.at(0).sheen;
    EXPECT_EQ(s.color, vec3(0.5F, 0.25F, 1.0F));
    EXPECT_EQ(s.roughness, 0.75F);
    expectTexture(loaded.scene, s.colorTexture, 1);
    expectTexture(loaded.scene, s.roughnessTexture, 2);
    EXPECT_EQ(materialOf(withExtension("KHR_materials_sheen", json::object())).sheen.color, vec3(0.0F));
}

TEST(GltfExtensions, AnisotropyHasItsFactorsAndTexture) {
    GltfBuilder b = withExtension("KHR_materials_anisotropy", json::object());
    b.document["materials"][0]["extensions"]["KHR_materials_anisotropy"] = {
        {"anisotropyStrength", 0.5},
        {"anisotropyRotation", 1.25},
        {"anisotropyTexture", {{"index", b.addTexture({1, 0, 0, 255})}}}};
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    const Anisotropy& a = loaded.scene.materials.at(0).anisotropy;
    EXPECT_EQ(a.strength, 0.5F);
    EXPECT_EQ(a.rotation, 1.25F);
    expectTexture(loaded.scene, a.texture, 1);
}

TEST(GltfExtensions, DispersionIsThatOfAVolume) {
    GltfBuilder b = withExtension("KHR_materials_transmission", {{"transmissionFactor", 1}});
    json& extensions = b.document["materials"][0]["extensions"];
    extensions["KHR_materials_dispersion"] = {{"dispersion", 0.5}};
    b.document["extensionsUsed"].push_back("KHR_materials_dispersion");
    EXPECT_EQ(load(b).scene.materials.at(0).transmission.dispersion, 0.0F) << "a sheet bends no light";
    extensions["KHR_materials_volume"] = {{"thicknessFactor", 1}};
    b.document["extensionsUsed"].push_back("KHR_materials_volume");
    const Loaded loaded = load(b);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.scene.materials.at(0).transmission.dispersion, 0.5F);
}

TEST(GltfExtensions, UnlitSurfacesHaveNeitherGlassNorCoat) {
    GltfBuilder b = withExtension("KHR_materials_unlit", json::object());
    b.document["materials"][0]["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
    b.document["materials"][0]["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1}};
    const Material m = load(b).scene.materials.at(0);
    EXPECT_EQ(m.transmission.factor, 0.0F);
    EXPECT_EQ(m.clearcoat.factor, 0.0F);
}

std::string complaintAbout(GltfBuilder b) {
    return complaint(b.writeGltf(testFolder() / "scene.gltf"));
}

TEST(GltfExtensions, ValuesOutOfRangeAreErrors) {
    const auto specular = [](const json& extension) {
        return complaintAbout(withExtension("KHR_materials_specular", extension));
    };
    const std::string part = "materials[0].extensions.KHR_materials_specular.";
    EXPECT_EQ(specular({{"specularFactor", 1.5}}), part + "specularFactor: is 1.5, not between 0 and 1");
    EXPECT_EQ(specular({{"specularColorFactor", {1, 1}}}), part + "specularColorFactor: has 2 elements, not 3");
    EXPECT_TRUE(specular({{"specularColorFactor", {1, -1, 1}}}).starts_with(part + "specularColorFactor[1]: is -1"));
    EXPECT_EQ(specular({{"specularTexture", {{"index", 3}}}}),
              part + "specularTexture.index: is 3, but there are 0 textures");
    EXPECT_EQ(specular({{"specularColorTexture", json::object()}}), part + "specularColorTexture.index: is missing");
    EXPECT_EQ(complaintAbout(withExtension("KHR_materials_transmission", {{"transmissionFactor", 2}})),
              "materials[0].extensions.KHR_materials_transmission.transmissionFactor: is 2, not between 0 and 1");
    EXPECT_EQ(complaintAbout(withExtension("KHR_materials_clearcoat", {{"clearcoatRoughnessFactor", -1}})),
              "materials[0].extensions.KHR_materials_clearcoat.clearcoatRoughnessFactor: is -1, not between 0 and 1");
    EXPECT_TRUE(complaintAbout(withExtension("KHR_materials_volume", {{"thicknessFactor", -1}}))
                    .starts_with("materials[0].extensions.KHR_materials_volume.thicknessFactor: is -1"));
    EXPECT_TRUE(complaintAbout(withExtension("KHR_materials_dispersion", {{"dispersion", -1}}))
                    .starts_with("materials[0].extensions.KHR_materials_dispersion.dispersion: is -1"));
    EXPECT_TRUE(complaintAbout(withExtension("KHR_materials_sheen", {{"sheenColorFactor", {0, 2, 0}}}))
                    .starts_with("materials[0].extensions.KHR_materials_sheen.sheenColorFactor[1]: is 2"));
    EXPECT_TRUE(complaintAbout(withExtension("KHR_materials_anisotropy", {{"anisotropyStrength", 2}}))
                    .starts_with("materials[0].extensions.KHR_materials_anisotropy.anisotropyStrength: is 2"));
    EXPECT_TRUE(complaintAbout(withExtension("KHR_materials_ior", {{"ior", -1}}))
                    .starts_with("materials[0].extensions.KHR_materials_ior.ior: is -1"));
    EXPECT_EQ(complaintAbout(withExtension("KHR_materials_unlit", 7)),
              "materials[0].extensions.KHR_materials_unlit: is a number, not an object");
}

// Two triangles: red, or blue in "night" and "dusk"; and green, always.
GltfBuilder withVariants() {
    GltfBuilder b = triangle();
    b.document["extensionsUsed"] = {"KHR_materials_variants"};
    b.document["extensionsRequired"] = {"KHR_materials_variants"};
    b.document["extensions"]["KHR_materials_variants"]["variants"] = {
        {{"name", "day"}}, {{"name", "night"}}, {{"name", "dusk"}}};
    const auto colored = [&](const char* name) { return b.add("materials", {{"name", name}}); };
    json& primitive = b.document["meshes"][0]["primitives"][0];
    primitive["material"] = colored("red");
    primitive["extensions"]["KHR_materials_variants"]["mappings"] =
        json::array({{{"variants", {1, 2}}, {"material", colored("blue")}}});
    b.addPrimitive({{"attributes", {{"POSITION", 0}}}, {"material", colored("green")}});
    return b;
}

std::string materialsIn(const std::string& variant) {
    const Scene scene =
        loadGltf(withVariants().writeGltf(testFolder() / "scene.gltf"), {.variant = variant, .warn = nullptr});
    EXPECT_EQ(scene.variants, (std::vector<std::string>{"day", "night", "dusk"}));
    std::string names;
    for (const Instance& instance : scene.instances) {
        names += scene.materials.at(scene.meshes.at(instance.mesh).material).name + " ";
    }
    return names;
}

TEST(GltfExtensions, AVariantChangesTheMaterialsThatItNames) {
    EXPECT_EQ(materialsIn(""), "red green ");
    EXPECT_EQ(materialsIn("day"), "red green ");
    EXPECT_EQ(materialsIn("night"), "blue green ");
    EXPECT_EQ(materialsIn("dusk"), "blue green ");
}

TEST(GltfExtensions, AnUnknownVariantIsAnErrorThatListsThem) {
    const auto error = [](GltfBuilder b) -> std::string {
        try {
            loadGltf(b.writeGltf(testFolder() / "scene.gltf"), {.variant = "noon", .warn = nullptr});
        } catch (const UsageError& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_TRUE(
        error(withVariants()).ends_with("there is no material variant 'noon'; the file's variants: day, night, dusk"));
    EXPECT_TRUE(error(triangle()).ends_with("there is no material variant 'noon'; the file's variants: none"));
}

TEST(GltfExtensions, BrokenVariantsAreErrors) {
    const auto with = [](const char* pointer, const json& value) {
        GltfBuilder b = withVariants();
        b.document[json::json_pointer(pointer)] = value;
        return complaintAbout(std::move(b));
    };
    const std::string mappings = "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings";
    const std::string part = "meshes[0].primitives[0].extensions.KHR_materials_variants.mappings";
    EXPECT_EQ(with((mappings + "/0/variants").c_str(), json::array({3})),
              part + "[0].variants[0]: is 3, but there are 3 variants");
    EXPECT_EQ(with((mappings + "/0/material").c_str(), 9), part + "[0].material: is 9, but there are 3 materials");
    EXPECT_EQ(with(mappings.c_str(), 1), part + ": is a number, not an array");
    EXPECT_EQ(with(mappings.c_str(), json::array()), "");
    EXPECT_EQ(with("/extensions/KHR_materials_variants/variants/1", json::object()),
              "extensions.KHR_materials_variants.variants[1].name: is missing");
}

}  // namespace
}  // namespace reflet::test::gltf_extensions_test
