// Loads glTF 2.0 files (.gltf, .glb) into a Scene: read and check the document, choose the scene, place its nodes.
#include "scene/gltf/gltf.h"
#include "scene/gltf/clips.h"

#include "base/message.h"
#include "scene/gltf/lens.h"
#include "scene/gltf/nodes.h"
#include "scene/opacity.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

namespace reflet {

namespace {

/// The roots of the chosen scene. A file without scenes is a library of parts: all of them are shown.
std::vector<int> chooseScene(GltfDocument& document, int wanted, std::string& name, GltfReport& report) {
    const auto& scenes = document.model.scenes;
    if (wanted >= 0 && static_cast<size_t>(wanted) >= scenes.size()) {
        report.failUsage("", "there is no scene {}: the file has {} {}, numbered from 0", wanted, scenes.size(),
                         scenes.size() == 1 ? "scene" : "scenes");
    }
    if (scenes.empty()) {
        report.warn("no scenes", "scenes", "all nodes will be drawn: the file defines no scene");
        std::vector<int> roots;
        for (size_t i = 0; i < document.isChild.size(); ++i) {
            if (!document.isChild[i]) {
                roots.push_back(static_cast<int>(i));
            }
        }
        return roots;
    }
    const int chosen = wanted >= 0 ? wanted : std::max(document.model.defaultScene, 0);
    name = scenes[static_cast<size_t>(chosen)].name;
    return rootsOfGltfScene(document, static_cast<size_t>(chosen));
}

/// Turns the scene by a node of its own above its roots, so that the file's Z axis points up.
std::vector<int> turnedUp(GltfDocument& document, const std::vector<int>& roots) {
    const double half = std::sqrt(0.5);
    tinygltf::Node turn;
    turn.rotation = {-half, 0.0, 0.0, half};
    turn.children = roots;
    for (const int root : roots) {
        document.isChild[static_cast<size_t>(root)] = true;
    }
    document.model.nodes.push_back(std::move(turn));
    document.isChild.push_back(false);
    return {static_cast<int>(document.model.nodes.size() - 1)};
}

std::vector<std::string> variantNames(const tinygltf::Model& model) {
    std::vector<std::string> names;
    if (const auto found = model.extensions.find("KHR_materials_variants"); found != model.extensions.end()) {
        const tinygltf::Value& variants = found->second.Get("variants");
        for (size_t i = 0; i < variants.Size(); ++i) {
            names.push_back(variants.Get(static_cast<int>(i)).Get("name").Get<std::string>());
        }
    }
    return names;
}

/// Index of the chosen variant; -1: none.
int chooseVariant(const std::vector<std::string>& names, const std::string& wanted, const GltfReport& report) {
    if (wanted.empty()) {
        return -1;
    }
    const auto found = std::ranges::find(names, wanted);
    if (found == names.end()) {
        report.failUsage("", "there is no material variant '{}'; the file's variants: {}", wanted, listed(names));
    }
    return static_cast<int>(found - names.begin());
}

Scene readScene(const std::filesystem::path& path, const GltfOptions& options, GltfReport& report) {
    GltfDocument document = readGltfDocument(path, report, options.scene);
    Scene scene;
    scene.fromFile = true;
    std::vector<int> roots = chooseScene(document, options.scene, scene.name, report);
    if (options.zUp) {
        roots = turnedUp(document, roots);
    }
    if (scene.name.empty()) {
        scene.name = path.stem().string();
    }
    GltfMaterials materials(document, scene, report);
    scene.extensions = document.model.extensionsUsed;
    scene.variants = variantNames(document.model);
    scene.clips = chooseGltfAnimations(document, options.animation, report);
    GltfMeshes meshes(document, materials, scene, report, chooseVariant(scene.variants, options.variant, report));
    const GltfPlacement placement = placeGltfNodes(document, roots, meshes, scene, report);
    bindGltfProperties(document, materials, placement, scene, report);
    checkGltfFocus(scene, report);
    makeOpaqueWhereAlphaIsOne(scene);
    if (scene.instances.empty()) {
        report.fail("", "nothing is left to draw: {}",
                    report.firstProblem().empty() ? "no node of the scene shows a mesh" : report.firstProblem());
    }
    return scene;
}

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options) {
    GltfReport report(path.string(), options.warn, options.strict);
    try {
        Scene scene = readScene(path, options, report);
        report.printWarnings();
        return scene;
    } catch (const Error&) {
        report.printWarnings();
        throw;
    } catch (const std::bad_alloc&) {
        report.fail("", "needs more memory than is available");
    } catch (const std::length_error&) {
        report.fail("", "needs more memory than is available");
    }
}

}  // namespace reflet
