// What the drawn scene does not use of a glTF file is checked, but not kept.
#include "gltf_builder.h"
#include "scene/gltf/document.h"

#include <gtest/gtest.h>

namespace reflet::test::gltf_unused_test {
namespace {

using nlohmann::json;

GltfDocument read(GltfBuilder builder, int scene = -1) {
    const std::filesystem::path file = testFolder() / "unused.gltf";
    builder.document["buffers"] = json::array(
        {{{"byteLength", builder.bin.size()}, {"uri", "data:application/octet-stream;base64," + base64(builder.bin)}}});
    writeBytes(file, builder.document.dump());
    GltfReport report(file.string(), {}, true);
    return readGltfDocument(file, report, scene);
}

/// An animation of the node, as the only one of slider() is.
json animationOf(const GltfBuilder& builder, int node) {
    json animation = builder.document["animations"][0];
    animation["channels"][0]["target"]["node"] = node;
    return animation;
}

TEST(GltfUnused, AnimationsOfNodesOutsideTheDrawnSceneAreNotKept) {
    GltfBuilder b = slider();
    const int other = b.add("nodes", {{"name", "other"}});
    for (int i = 0; i < 1000; ++i) {
        b.add("animations", animationOf(b, other));
    }
    b.add("animations", animationOf(b, 0));
    b.add("scenes", {{"nodes", {other}}});
    const GltfDocument first = read(b);
    ASSERT_EQ(first.animations.size(), 2U);
    EXPECT_TRUE(first.animations.contains(0));
    EXPECT_TRUE(first.animations.contains(1001)) << "keeps its index, which messages name";
    EXPECT_EQ(read(b, 1).animations.size(), 1000U);
    EXPECT_EQ(load(b).scene.clips.size(), 2U);
    b.document.erase("scenes");
    b.document.erase("scene");
    EXPECT_EQ(read(b).animations.size(), 1002U) << "a file without scenes shows all its nodes";
}

TEST(GltfUnused, WhatJointsHangFromIsUsed) {
    GltfBuilder b = bent();  // its joints are nodes 1 and 2
    b.document["animations"] = slider().document["animations"];
    const int times = b.addFloats({0, 2}, "SCALAR");
    const int places = b.addFloats({0, 0, 0, 4, 0, 0}, "VEC3");
    b.document["animations"][0]["samplers"][0] = {{"input", times}, {"output", places}};
    const int above = b.add("nodes", {{"name", "above"}});
    for (const int node : {1, 2}) {
        bool isChild = false;
        for (const json& other : b.document["nodes"]) {
            for (const json& child : other.value("children", json::array())) {
                isChild = isChild || child == node;
            }
        }
        if (!isChild) {
            b.document["nodes"][static_cast<size_t>(above)]["children"].push_back(node);
        }
    }
    b.document["scenes"][0]["nodes"] = {0};  // the joints are in no scene
    b.document["animations"][0]["channels"][0]["target"]["node"] = above;
    EXPECT_EQ(read(b).animations.size(), 1U);
}

TEST(GltfUnused, OnlyMaterialsOfMeshesAreKept) {
    GltfBuilder b = triangle();
    for (int i = 0; i < 1000; ++i) {
        b.add("materials", {{"name", std::to_string(i)}});
    }
    json& primitive = b.document["meshes"][0]["primitives"][0];
    primitive["material"] = 700;
    b.document["extensionsUsed"] = {"KHR_materials_variants"};
    b.document["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}};
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 30}, {"variants", {0}}}};
    const GltfDocument document = read(b);
    ASSERT_EQ(document.materials.size(), 2U);
    EXPECT_EQ(document.materials.at(30).name, "30");
    EXPECT_EQ(document.materials.at(700).name, "700");
}

TEST(GltfUnused, PiecesAreInTheFilesOrder) {
    GltfBuilder b = triangle();
    const std::string longName(1000, 'n');
    for (int i = 0; i < 3000; ++i) {  // three pieces
        b.add("nodes", {{"name", longName + std::to_string(i)}});
    }
    const GltfDocument document = read(b);
    ASSERT_EQ(document.model.nodes.size(), 3001U);
    EXPECT_EQ(document.model.nodes[0].mesh, 0);
    EXPECT_EQ(document.model.nodes[3000].name, longName + "2999");
}

TEST(GltfUnused, EqualBuffersAreReadOnce) {
    GltfBuilder b = slider();
    const std::filesystem::path file = testFolder() / "equal.gltf";
    const json buffer = {{"byteLength", b.bin.size()},
                         {"uri", "data:application/octet-stream;base64," + base64(b.bin)}};
    b.document["buffers"] = json(100, buffer);
    size_t next = 0;
    for (json& view : b.document["bufferViews"]) {
        view["buffer"] = ++next;
    }
    writeBytes(file, b.document.dump());
    GltfReport report(file.string(), {}, true);
    const GltfDocument document = readGltfDocument(file, report, -1);
    size_t bytes = 0;
    for (const tinygltf::Buffer& read : document.model.buffers) {
        bytes += read.data.size();
    }
    EXPECT_EQ(bytes, b.bin.size());
    EXPECT_GT(next, 1U);
}

}  // namespace
}  // namespace reflet::test::gltf_unused_test
