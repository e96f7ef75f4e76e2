// Loads glTF 2.0 files (.gltf, .glb) into a Scene: read and check the document, choose the scene, place its nodes.
#include "scene/gltf.h"

#include "scene/gltf_nodes.h"

#include <algorithm>
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

Scene readScene(const std::filesystem::path& path, int wanted, GltfReport& report) {
    GltfDocument document = readGltfDocument(path, report);
    Scene scene;
    const std::vector<int> roots = chooseScene(document, wanted, scene.name, report);
    if (scene.name.empty()) {
        scene.name = path.stem().string();
    }
    GltfMaterials materials(document, scene, report);
    GltfMeshes meshes(document, materials, scene, report);
    placeGltfNodes(document, roots, meshes, scene, report);
    if (scene.instances.empty() && !report.firstProblem().empty()) {
        report.fail("", "nothing is left to draw: {}", report.firstProblem());
    }
    return scene;
}

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options) {
    GltfReport report(path.string(), options.warn, options.strict);
    try {
        Scene scene = readScene(path, options.scene, report);
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
