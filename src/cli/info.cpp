// `reflet info`: what is in a scene, and what will not be drawn.
#include "base/error.h"
#include "base/json_text.h"
#include "base/visible_text.h"
#include "cli/commands.h"
#include "job/camera_options.h"
#include "scene/builtin.h"
#include "scene/framing.h"
#include "scene/gltf/gltf.h"
#include "scene/pose.h"
#include "scene/view_file.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace reflet {

namespace {

using nlohmann::ordered_json;

constexpr float automaticAspect = 16.0F / 9.0F;  // of render's default size

struct InfoOptions {
    std::string file;
    bool json = false;
};

ordered_json numbers(const vec3& v) {
    return {v.x, v.y, v.z};
}

// A point of the world in the coordinates of the file.
ordered_json inFile(const Scene& scene, const vec3& point) {
    const glm::dvec3 p = scene.origin + glm::dvec3(point);
    return {p.x, p.y, p.z};
}

uint64_t trianglesOf(const Scene& scene, bool placed) {
    uint64_t count = 0;
    if (placed) {
        for (const Instance& instance : scene.instances) {
            count += scene.meshes[instance.mesh].indices.size() / 3;
        }
    } else {
        for (const Mesh& mesh : scene.meshes) {
            count += mesh.indices.size() / 3;
        }
    }
    return count;
}

ordered_json countsOf(const Scene& scene) {
    const auto countMaterials = [&](auto&& has) { return std::ranges::count_if(scene.materials, has); };
    return {{"instances", scene.instances.size()},
            {"meshes", scene.meshes.size()},
            {"triangles", trianglesOf(scene, false)},
            {"triangles_placed", trianglesOf(scene, true)},
            {"materials", scene.materials.size()},
            {"double_sided", countMaterials([](const Material& m) { return m.doubleSided; })},
            {"blended", countMaterials([](const Material& m) { return m.blended; })},
            {"transmissive", countMaterials([](const Material& m) { return m.transmission.factor > 0.0F; })},
            {"unlit", countMaterials([](const Material& m) { return m.unlit; })},
            {"emissive", countMaterials([](const Material& m) { return m.emissive != vec3(0.0F); })},
            {"images", scene.images.size()},
            {"skins", scene.skins.size()}};
}

ordered_json lampsOf(const Scene& scene) {
    auto lamps = ordered_json::array();
    if (scene.sun) {
        lamps.push_back({{"name", ""}, {"type", "directional"}, {"intensity", numbers(scene.sun->irradiance)}});
    }
    for (const Lamp& lamp : scene.lamps) {
        const char* type = lamp.type == Lamp::Type::point  ? "point"
                           : lamp.type == Lamp::Type::spot ? "spot"
                                                           : "directional";
        lamps.push_back({{"name", lamp.name}, {"type", type}, {"intensity", numbers(lamp.intensity)}});
    }
    return lamps;
}

ordered_json camerasOf(const Scene& scene) {
    auto cameras = ordered_json::array();
    for (const Camera& camera : scene.cameras) {
        cameras.push_back({{"name", camera.name},
                           {"type", camera.orthographicHeight > 0.0F ? "orthographic" : "perspective"},
                           {"position", inFile(scene, camera.position)}});
    }
    return cameras;
}

ordered_json animationsOf(const Scene& scene) {
    auto animations = ordered_json::array();
    for (const AnimationClip& clip : scene.clips) {
        animations.push_back(
            {{"name", clip.name}, {"seconds", clip.seconds}, {"channels", clip.channels}, {"plays", clip.plays}});
    }
    if (scene.fromFile) {
        return animations;
    }
    for (const Animation& animation : scene.animations) {
        float seconds = 0.0F;
        for (const Channel& channel : animation.channels) {
            seconds = std::max(seconds, channel.times.back());
        }
        for (const PropertyChannel& channel : animation.properties) {
            seconds = std::max(seconds, channel.keys.times.back());
        }
        animations.push_back({{"name", animation.name},
                              {"seconds", seconds},
                              {"channels", animation.channels.size() + animation.properties.size()},
                              {"plays", true}});
    }
    return animations;
}

ordered_json infoOf(const Scene& scene, const std::vector<std::string>& warnings) {
    ordered_json info{{"name", scene.name}, {"extensions", scene.extensions}, {"counts", countsOf(scene)}};
    const Aabb bounds = scene.bounds();
    if (!bounds.empty()) {
        info["bounds"] = {{"min", inFile(scene, bounds.min)}, {"max", inFile(scene, bounds.max)}};
    }
    if (scene.cameras.empty()) {
        info["automatic_camera"] = viewJson(defaultView(scene, automaticAspect))["camera"];
    }
    info["lights"] = lampsOf(scene);
    info["cameras"] = camerasOf(scene);
    info["animations"] = animationsOf(scene);
    info["variants"] = scene.variants;
    info["not_drawn"] = warnings;
    return info;
}

std::string nameOr(const ordered_json& named, const char* otherwise) {
    const std::string name = named["name"];
    return name.empty() ? otherwise : "'" + oneLine(name) + "'";
}

void line(const char* what, const std::string& value) {
    fmt::print("{:<14} {}\n", what, visibleText(value));
}

// A file may have hundreds of thousands: the first of them, and how many more there are.
template <class List, class Text>
void printList(const char* what, const List& list, const Text& text) {
    constexpr size_t most = 20;
    size_t shown = 0;
    for (const auto& entry : list) {
        if (shown == most) {
            line(what, fmt::format("… and {} more; --json lists all", list.size() - most));
            break;
        }
        line(what, text(entry));
        ++shown;
    }
}

void printLists(const Scene& scene, const ordered_json& info) {
    printList("light", info["lights"], [](const ordered_json& lamp) {
        return fmt::format("{}, {}", lamp["type"].get<std::string>(), nameOr(lamp, "without a name"));
    });
    printList("camera", info["cameras"], [](const ordered_json& camera) {
        return fmt::format("{}, {}", nameOr(camera, "without a name"), camera["type"].get<std::string>());
    });
    printList("animation", info["animations"], [](const ordered_json& animation) {
        return fmt::format("{}, {:.4g} s, {} channels{}", nameOr(animation, "without a name"),
                           animation["seconds"].get<double>(), animation["channels"].get<uint64_t>(),
                           animation["plays"].get<bool>() ? "" : ", does not play unless --animation names it");
    });
    printList("variant", scene.variants, [](const std::string& variant) { return oneLine(variant); });
    printList("not drawn", info["not_drawn"], [](const ordered_json& warning) { return warning.get<std::string>(); });
}

void printText(const Scene& scene, const ordered_json& info) {
    line("scene", oneLine(scene.name));
    std::vector<std::string> extensions;
    std::ranges::transform(scene.extensions, std::back_inserter(extensions),
                           [](const std::string& name) { return oneLine(name); });
    line("extensions", extensions.empty() ? "none" : fmt::format("{}", fmt::join(extensions, ", ")));
    std::vector<std::string> counts;
    for (const auto& [name, value] : info["counts"].items()) {
        std::string words = name;
        std::ranges::replace(words, '_', ' ');
        counts.push_back(fmt::format("{} {}", value.get<uint64_t>(), words));
    }
    line("counts", fmt::format("{}", fmt::join(counts, ", ")));
    const Aabb bounds = scene.bounds();
    if (!bounds.empty()) {
        const vec3 size = bounds.size();
        line("size", fmt::format("{:.4g} x {:.4g} x {:.4g} m", size.x, size.y, size.z));
        const glm::dvec3 low = scene.origin + glm::dvec3(bounds.min);
        const glm::dvec3 high = scene.origin + glm::dvec3(bounds.max);
        line("bounds",
             fmt::format("{:.6g},{:.6g},{:.6g} to {:.6g},{:.6g},{:.6g}", low.x, low.y, low.z, high.x, high.y, high.z));
    }
    if (scene.cameras.empty()) {
        const Camera camera = framingCamera(scene, automaticAspect);
        const Direction from = directionOf(glm::dvec3(camera.position) - glm::dvec3(camera.target));
        const glm::dvec3 target = scene.origin + glm::dvec3(camera.target);
        line("camera",
             fmt::format("automatic: --orbit {:.3g},{:.3g},{:.4g} --look-at {:.6g},{:.6g},{:.6g} --fov {:.4g}",
                         from.azimuth, from.elevation, glm::distance(camera.position, camera.target), target.x,
                         target.y, target.z, glm::degrees(camera.fovY)));
    }
    printLists(scene, info);
}

Scene opened(const std::string& file, std::vector<std::string>& warnings) {
    constexpr std::string_view builtin = "builtin:";
    if (file.starts_with(builtin)) {
        if (std::optional<Scene> scene = makeBuiltinScene(std::string_view(file).substr(builtin.size()))) {
            return std::move(*scene);
        }
        failUsage("no built-in scene is called '{}' (see reflet list scenes)", file.substr(builtin.size()));
    }
    return loadGltf(file, {.variant = {}, .warn = [&](const std::string& text) { warnings.push_back(text); }});
}

void info(const InfoOptions& options) {
    std::vector<std::string> warnings;
    const Scene scene = opened(options.file, warnings);
    const ordered_json all = infoOf(scene, warnings);
    if (options.json) {
        fmt::print("{}\n", jsonText(all, 2));
    } else {
        printText(scene, all);
    }
}

}  // namespace

void addInfoCommand(CLI::App& app) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command = app.add_subcommand("info", "Show what is in a glTF file, and what of it will not be drawn");
    command->add_option("SCENE", options->file, "A .gltf or .glb file, or builtin:NAME")->required();
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([options] { info(*options); });
}

}  // namespace reflet
