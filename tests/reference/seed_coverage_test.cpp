// What the scenes of the fuzz targets have: every property that the loader reads, and each one changes a picture. A
// seed whose meshes are never drawn tests nothing of them.
#include "base/error.h"
#include "reference/reference.h"
#include "scene/framing.h"
#include "scene/gltf/schema_tables.h"
#include "unit/gltf_showcase.h"

#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <set>

namespace reflet::test::seed_coverage_test {
namespace {

using gltf_schema::Field;
using gltf_schema::Type;
using nlohmann::json;
using Names = std::map<const Field*, std::string>;

/// All properties, by where the schema has them first: it shares those of textures, for example.
void collect(std::span<const Field> fields, const std::string& at, Names& names) {
    for (const Field& field : fields) {
        if (names.emplace(&field, at + field.name).second) {
            collect(field.fields, at + field.name + (field.array ? "[]." : "."), names);
        }
    }
}

/// Calls `visit` for each member of a document that the schema knows.
void walk(const json& object, std::span<const Field> fields, const json::json_pointer& at,
          const std::function<void(const Field&, const json::json_pointer&)>& visit) {
    for (const Field& field : fields) {
        const auto member = object.find(field.name);
        if (member == object.end()) {
            continue;
        }
        visit(field, at / field.name);
        for (size_t i = 0; member->is_array() && field.type == Type::object && i < member->size(); ++i) {
            walk((*member)[i], field.fields, at / field.name / i, visit);
        }
        if (member->is_object() && field.type == Type::object) {
            walk(*member, field.fields, at / field.name, visit);
        }
    }
}

bool mayChangeNothing(const std::string& name) {
    const std::set<std::string_view> known{
        // Other data says the same.
        "asset.minVersion", "extensionsUsed", "extensionsRequired", "images[].mimeType", "buffers[].uri",
        "buffers[].extensions", "buffers[].extensions.EXT_meshopt_compression",
        "buffers[].extensions.KHR_meshopt_compression", "buffers[].extensions.EXT_meshopt_compression.fallback",
        // Of the picture's own shape and unbounded view.
        "cameras[].perspective.aspectRatio", "cameras[].perspective.zfar",
        // The renderer's alone: mip levels, occlusion that the reference traces, how thick glass is,
        // what another camera sees.
        "samplers[].minFilter", "materials[].occlusionTexture",
        "materials[].pbrMetallicRoughness.baseColorTexture.strength",
        "materials[].extensions.KHR_materials_volume.thicknessTexture", "materials[].extras",
        "materials[].extras.camera"};
    return name.ends_with("name") || known.contains(name);
}

TEST(SeedCoverage, EveryPropertyThatTheLoaderReadsIsInASeed) {
    Names all;
    collect(gltf_schema::document(), "", all);
    Names missing = all;
    for (const auto& [name, seed] : showcase()) {
        walk(seed.document, gltf_schema::document(), json::json_pointer(),
             [&](const Field& field, const json::json_pointer&) { missing.erase(&field); });
    }
    std::cout << all.size() - missing.size() << " of " << all.size() << " properties are in a seed\n";
    for (const auto& [field, name] : missing) {
        ADD_FAILURE() << name;
    }
    std::set<std::string> used;
    for (const auto& [name, seed] : showcase()) {
        const json extensions = seed.document.value("extensionsUsed", json::array());
        for (const json& extension : extensions) {
            used.insert(extension.get<std::string>());
        }
    }
    for (const std::string_view extension : gltf_schema::knownExtensions) {
        EXPECT_TRUE(used.contains(std::string(extension))) << extension;
    }
}

/// Adds pictures of the scene, through its cameras and framed, at two times.
void addPictures(const Scene& scene, std::string& all) {
    std::vector<Camera> cameras = scene.cameras;
    cameras.push_back(framingCamera(scene, 4.0F / 3.0F));
    for (const Camera& camera : cameras) {
        for (const double time : {0.0, 0.7}) {
            View view = defaultView(scene, 4.0F / 3.0F);
            view.camera = camera;
            view.time = time;
            view.environment.radiance = vec3(0.5F);  // so that nothing is black
            const FloatImage picture = traceReference(scene, view, {24, 18}, {.samples = 2, .threads = 1}).final;
            all.append(reinterpret_cast<const char*>(picture.data.data()), picture.data.size() * sizeof(float));
        }
    }
}

/// Of all variants.
std::string pictures(GltfBuilder builder) {
    const auto path = builder.writeGlb(testFolder() / "scene.glb");
    std::string all;
    for (const char* variant : {"", "night"}) {
        try {
            addPictures(loadGltf(path, {.variant = variant}), all);
        } catch (const Error& error) {
            all += std::string("an error: ") + error.what();
        }
    }
    return all;
}

/// What a seed has to draw each time that it refers to it.
bool isThing(const Field& field) {
    const std::set<std::string_view> things{"mesh", "material", "skin", "light", "camera", "index", "targets"};
    return things.contains(field.name);
}

/// Things that no picture of the reference shows: one that is invisible and one of another scene among them.
bool isHidden(const std::string& member) {
    return member.find("/occlusionTexture/") != std::string::npos ||
           member.find("/thicknessTexture/") != std::string::npos || member == "staged/nodes/2/mesh" ||
           member.ends_with("/extras/camera") || member == "staged/nodes/12/mesh";
}

// Over 5 s: a picture without each of some 600 members.
TEST(SeedCoverage, EachPropertyChangesAPictureOfASeed) {
    Names idle;
    collect(gltf_schema::document(), "", idle);
    size_t members = 0;
    for (const auto& [name, seed] : showcase()) {
        const std::string right = pictures(seed);
        ASSERT_FALSE(right.starts_with("an error")) << name << ": " << right;
        walk(seed.document, gltf_schema::document(), json::json_pointer(),
             [&](const Field& field, const json::json_pointer& at) {
                 if (!idle.contains(&field) && !isThing(field)) {
                     return;
                 }
                 GltfBuilder without = seed;
                 without.document.at(at.parent_pointer()).erase(at.back());
                 if (pictures(without) != right) {
                     idle.erase(&field);
                     ++members;
                 } else if (isThing(field) && !isHidden(name + at.to_string())) {
                     ADD_FAILURE() << name << at.to_string() << " is not drawn";
                 }
             });
    }
    std::cout << members << " members of seeds change a picture\n";
    for (const auto& [field, name] : idle) {
        if (!mayChangeNothing(name)) {
            ADD_FAILURE() << name << " changes no picture";
        }
    }
}

}  // namespace
}  // namespace reflet::test::seed_coverage_test
