// Reads the copies of a mesh that EXT_mesh_gpu_instancing places.
#include "scene/gltf/instancing.h"

#include "scene/gltf/accessor.h"
#include "scene/pose.h"

#include <optional>

namespace reflet {

namespace {

constexpr uint64_t bytesPerCopy = 512;  // of an instance, its draw and its place in acceleration structures

std::optional<AccessorView> openAttribute(const GltfDocument& document, const tinygltf::Value& attributes,
                                          const char* name, int components, const std::string& part,
                                          GltfReport& report) {
    if (!attributes.Has(name)) {
        return std::nullopt;
    }
    const AccessorView view = viewAccessor(document, attributes.Get(name).GetNumberAsInt(), report);
    if (view.components != components || view.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        report.fail(fmt::format("{}.{}", part, name), "is not an accessor of VEC{} floats or small integers",
                    components);
    }
    return view;
}

glm::dvec4 valueAt(const std::optional<AccessorView>& view, uint32_t i, const glm::dvec4& otherwise,
                   const std::string& part, const GltfReport& report) {
    if (!view) {
        return otherwise;
    }
    const vec4 value = view->at(i);
    if (!isFinite(value)) {
        report.fail(part, "value {} is not finite", i);
    }
    return value;
}

}  // namespace

std::vector<glm::dmat4> readGltfCopies(const GltfDocument& document, const tinygltf::Node& node,
                                       const std::string& part, GltfReport& report) {
    const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
    if (extension == node.extensions.end()) {
        return {glm::dmat4(1.0)};
    }
    const std::string here = part + ".extensions.EXT_mesh_gpu_instancing.attributes";
    const tinygltf::Value& attributes = extension->second.Get("attributes");
    const auto translation = openAttribute(document, attributes, "TRANSLATION", 3, here, report);
    const auto rotation = openAttribute(document, attributes, "ROTATION", 4, here, report);
    const auto scale = openAttribute(document, attributes, "SCALE", 3, here, report);
    std::optional<uint32_t> count;
    for (const auto* view : {&translation, &rotation, &scale}) {
        if (*view && count.value_or((*view)->count) != (*view)->count) {
            report.fail(here, "have {} and {} elements, must have as many", *count, (*view)->count);
        }
        count = *view ? (*view)->count : count;
    }
    if (!count) {
        report.warn("instances without place", here, "one copy of the mesh will be drawn: no attribute places others");
        return {glm::dmat4(1.0)};
    }
    report.charge(here, *count * bytesPerCopy);
    std::vector<glm::dmat4> copies;
    copies.reserve(*count);
    for (uint32_t i = 0; i < *count; ++i) {
        Node copy;
        copy.translation = valueAt(translation, i, glm::dvec4(0.0), here + ".TRANSLATION", report);
        copy.scale = valueAt(scale, i, glm::dvec4(1.0), here + ".SCALE", report);
        const glm::dvec4 turn = valueAt(rotation, i, glm::dvec4(0, 0, 0, 1), here + ".ROTATION", report);
        const double length = glm::length(turn);
        if (length > 0.0) {
            copy.rotation = glm::dquat(turn.w, turn.x, turn.y, turn.z) / length;
        } else {
            report.warn("instance rotation", here + ".ROTATION",
                        "instance {} will not be rotated: its quaternion's length is 0", i);
        }
        copies.push_back(localTransform(copy));
    }
    return copies;
}

}  // namespace reflet
