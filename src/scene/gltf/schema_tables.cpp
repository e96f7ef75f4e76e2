// The properties of a glTF document that the loader reads, as tables: JSON schemas of the Khronos glTF 2.0
// specification, 2021, and of the extensions in knownExtensions.
#include "scene/gltf/schema_tables.h"

#include "scene/environment.h"
#include "scene/gltf/schema_materials.h"
#include "scene/gltf/schema_values.h"

#include <algorithm>

namespace reflet::gltf_schema {

namespace {

constexpr std::array asset{
    Field{.name = "version", .type = Type::text, .required = true},
    Field{.name = "minVersion", .type = Type::text},
};

// Buffers, views and accessors.
constexpr std::array meshoptBuffer{
    Field{.name = "fallback", .type = Type::boolean},
};
constexpr std::array bufferExtensions{
    Field{.name = "EXT_meshopt_compression", .type = Type::object, .fields = meshoptBuffer},
    Field{.name = "KHR_meshopt_compression", .type = Type::object, .fields = meshoptBuffer},
};
constexpr std::array buffer{
    Field{.name = "uri", .type = Type::text, .vital = true},
    Field{.name = "byteLength", .type = Type::integer, .required = true, .min = 1},
    Field{.name = "extensions", .type = Type::object, .fields = bufferExtensions},
};
constexpr std::array meshopt{
    Field{.name = "buffer", .type = Type::index, .required = true, .refersTo = "buffers"},
    Field{.name = "byteOffset", .type = Type::integer},
    Field{.name = "byteLength", .type = Type::integer, .required = true, .min = 1},
    Field{.name = "byteStride", .type = Type::integer, .required = true, .min = 1, .max = 256},
    Field{.name = "count", .type = Type::integer, .required = true, .min = 1},
    Field{.name = "mode", .type = Type::text, .required = true, .words = meshoptModes},
    Field{.name = "filter", .type = Type::text, .words = meshoptFilters},
};
constexpr std::array viewExtensions{
    Field{.name = "EXT_meshopt_compression", .type = Type::object, .fields = meshopt},
    Field{.name = "KHR_meshopt_compression", .type = Type::object, .fields = meshopt},
};
constexpr std::array bufferView{
    Field{.name = "buffer", .type = Type::index, .required = true, .refersTo = "buffers"},
    Field{.name = "byteOffset", .type = Type::integer, .vital = true},
    Field{.name = "byteLength", .type = Type::integer, .required = true, .min = 1},
    Field{.name = "byteStride", .type = Type::integer, .min = 4, .max = 252, .multipleOf = 4, .vital = true},
    Field{.name = "extensions", .type = Type::object, .fields = viewExtensions},
};
constexpr std::array sparseIndices{
    Field{.name = "bufferView", .type = Type::index, .required = true, .refersTo = "bufferViews"},
    Field{.name = "byteOffset", .type = Type::integer, .max = maxInt, .vital = true},
    Field{.name = "componentType", .type = Type::integer, .required = true, .numbers = indexTypes},
};
constexpr std::array sparseValues{
    Field{.name = "bufferView", .type = Type::index, .required = true, .refersTo = "bufferViews"},
    Field{.name = "byteOffset", .type = Type::integer, .max = maxInt, .vital = true},
};
constexpr std::array sparse{
    Field{.name = "count", .type = Type::integer, .required = true, .min = 1, .max = maxInt},
    Field{.name = "indices", .type = Type::object, .required = true, .fields = sparseIndices},
    Field{.name = "values", .type = Type::object, .required = true, .fields = sparseValues},
};
constexpr std::array accessor{
    Field{.name = "bufferView", .type = Type::index, .refersTo = "bufferViews", .vital = true},
    Field{.name = "byteOffset", .type = Type::integer, .vital = true},
    Field{.name = "componentType", .type = Type::integer, .required = true, .numbers = componentTypes},
    Field{.name = "normalized", .type = Type::boolean, .vital = true},
    Field{.name = "count", .type = Type::integer, .required = true, .min = 1, .max = 4294967294.0},
    Field{.name = "type", .type = Type::text, .required = true, .words = accessorTypes},
    Field{.name = "sparse", .type = Type::object, .fields = sparse, .vital = true},
};

// Images and textures.
constexpr std::array image{
    Field{.name = "name", .type = Type::text},
    Field{.name = "uri", .type = Type::text, .vital = true},
    Field{.name = "mimeType", .type = Type::text},
    Field{.name = "bufferView", .type = Type::index, .refersTo = "bufferViews", .vital = true},
};
constexpr std::array sampler{
    Field{.name = "magFilter", .type = Type::integer, .numbers = magFilters},
    Field{.name = "minFilter", .type = Type::integer, .numbers = minFilters},
    Field{.name = "wrapS", .type = Type::integer, .numbers = wraps},
    Field{.name = "wrapT", .type = Type::integer, .numbers = wraps},
};
constexpr std::array textureFormat{
    Field{.name = "source", .type = Type::index, .refersTo = "images", .vital = true},
};
constexpr std::array textureFormats{
    Field{.name = "EXT_texture_webp", .type = Type::object, .fields = textureFormat},
    Field{.name = "KHR_texture_basisu", .type = Type::object, .fields = textureFormat},
};
constexpr std::array texture{
    Field{.name = "sampler", .type = Type::index, .refersTo = "samplers"},
    Field{.name = "source", .type = Type::index, .refersTo = "images", .vital = true},
    Field{.name = "extensions", .type = Type::object, .fields = textureFormats},
};

// Meshes.
constexpr std::array draco{
    Field{.name = "bufferView", .type = Type::index, .required = true, .refersTo = "bufferViews"},
    Field{.name = "attributes", .type = Type::indexMap, .required = true},
};
constexpr std::array variantMapping{
    Field{.name = "variants", .type = Type::index, .required = true, .array = true, .refersTo = "variants"},
    Field{.name = "material", .type = Type::index, .required = true, .refersTo = "materials"},
};
constexpr std::array variantMappings{
    Field{.name = "mappings", .type = Type::object, .required = true, .array = true, .fields = variantMapping},
};
constexpr std::array primitiveExtensions{
    Field{.name = "KHR_materials_variants", .type = Type::object, .fields = variantMappings},
    Field{.name = "KHR_draco_mesh_compression", .type = Type::object, .fields = draco, .vital = true},
};
constexpr std::array primitive{
    Field{.name = "attributes",
          .type = Type::indexMap,
          .required = true,
          .refersTo = "accessors",
          .without = noAttribute},
    Field{.name = "indices", .type = Type::index, .refersTo = "accessors", .vital = true},
    Field{.name = "material", .type = Type::index, .refersTo = "materials"},
    Field{.name = "mode", .type = Type::integer, .max = 6, .vital = true},
    Field{.name = "targets", .type = Type::indexMap, .array = true, .refersTo = "accessors", .without = noTargets},
    Field{.name = "extensions", .type = Type::object, .fields = primitiveExtensions, .vital = true},
};
constexpr std::array mesh{
    Field{.name = "name", .type = Type::text},
    Field{.name = "primitives",
          .type = Type::object,
          .required = true,
          .array = true,
          .fields = primitive,
          .without = noPrimitive,
          .standIn = primitiveStandIn},
    Field{.name = "weights", .array = true},
};

// Nodes, cameras, lights, skins and animations.
constexpr std::array nodeLight{
    Field{.name = "light", .type = Type::index, .required = true, .refersTo = "lights"},
};
constexpr std::array instancing{
    Field{.name = "attributes", .type = Type::indexMap, .required = true, .refersTo = "accessors"},
};
constexpr std::array visibility{
    Field{.name = "visible", .type = Type::boolean},
};
constexpr std::array nodeExtensions{
    Field{.name = "EXT_mesh_gpu_instancing", .type = Type::object, .fields = instancing},
    Field{.name = "KHR_lights_punctual", .type = Type::object, .fields = nodeLight, .without = noLamp},
    Field{.name = "KHR_node_visibility", .type = Type::object, .fields = visibility},
};
constexpr std::array node{
    Field{.name = "name", .type = Type::text},
    Field{.name = "camera", .type = Type::index, .refersTo = "cameras", .without = noCamera},
    Field{
        .name = "children", .type = Type::index, .array = true, .refersTo = "nodes", .without = noNode, .standIn = ""},
    Field{.name = "skin", .type = Type::index, .refersTo = "skins", .without = noSkin},
    Field{.name = "mesh", .type = Type::index, .refersTo = "meshes", .without = noMesh},
    Field{.name = "matrix", .array = true, .items = 16},
    Field{.name = "translation", .array = true, .items = 3},
    Field{.name = "rotation", .array = true, .items = 4},
    Field{.name = "scale", .array = true, .items = 3},
    Field{.name = "weights", .array = true},
    Field{.name = "extensions", .type = Type::object, .fields = nodeExtensions},
};
constexpr std::array skin{
    Field{.name = "name", .type = Type::text},
    Field{.name = "inverseBindMatrices", .type = Type::index, .refersTo = "accessors", .vital = true},
    Field{.name = "joints", .type = Type::index, .required = true, .array = true, .refersTo = "nodes"},
};
constexpr std::array animationSampler{
    Field{.name = "input", .type = Type::index, .required = true, .refersTo = "accessors"},
    Field{.name = "output", .type = Type::index, .required = true, .refersTo = "accessors"},
    Field{.name = "interpolation", .type = Type::text, .words = interpolations},
};
constexpr std::array animationPointer{
    Field{.name = "pointer", .type = Type::text, .required = true},
};
constexpr std::array targetExtensions{
    Field{.name = "KHR_animation_pointer", .type = Type::object, .fields = animationPointer, .without = noChannel},
};
constexpr std::array channelTarget{
    Field{.name = "extensions", .type = Type::object, .fields = targetExtensions, .without = noChannel},
    Field{.name = "node", .type = Type::index, .refersTo = "nodes", .without = noChannel},
    Field{.name = "path", .type = Type::text, .required = true},
};
constexpr std::array channel{
    Field{.name = "sampler", .type = Type::integer, .required = true, .max = maxInt},
    Field{.name = "target", .type = Type::object, .required = true, .fields = channelTarget},
};
constexpr std::array animation{
    Field{.name = "name", .type = Type::text},
    Field{.name = "channels",
          .type = Type::object,
          .required = true,
          .array = true,
          .fields = channel,
          .without = noChannel,
          .standIn = channelStandIn},
    Field{.name = "samplers",
          .type = Type::object,
          .required = true,
          .array = true,
          .fields = animationSampler,
          .without = noChannel,
          .standIn = samplerStandIn},
};
constexpr std::array scene{
    Field{.name = "name", .type = Type::text},
    Field{.name = "nodes", .type = Type::index, .array = true, .refersTo = "nodes", .without = noNode, .standIn = ""},
};
constexpr std::array perspective{
    Field{.name = "aspectRatio", .min = 1e-6},
    Field{.name = "yfov", .required = true, .min = 1e-4, .max = 3.1415, .clamps = false},
    Field{.name = "znear", .required = true, .min = 1e-6},
    Field{.name = "zfar", .min = 1e-6},
};
constexpr std::array orthographic{
    Field{.name = "xmag", .required = true},
    Field{.name = "ymag", .required = true, .min = 1e-6, .clamps = false},
    Field{.name = "znear", .required = true, .min = 0},
    Field{.name = "zfar", .required = true, .min = 1e-6, .clamps = false},
};
// Reflet's own: the lens, with the keys of view files (scene/camera_json.h).
constexpr std::array cameraExtras{
    Field{.name = "aperture_radius", .min = 0, .max = 1000},
    Field{.name = "f_number", .min = 0.01, .max = 1e6},
    Field{.name = "sensor_height", .min = 0.01, .max = 1e6},
    Field{.name = "focus_distance", .min = 0, .max = 1e12},
    Field{.name = "focus", .type = Type::text},
    Field{.name = "blades", .type = Type::integer, .max = 16},
    Field{.name = "blade_rotation", .min = -360, .max = 360},
};
constexpr std::array camera{
    Field{.name = "name", .type = Type::text},
    Field{.name = "type", .type = Type::text, .required = true, .words = cameraTypes},
    Field{.name = "perspective", .type = Type::object, .fields = perspective, .vital = true},
    Field{.name = "orthographic", .type = Type::object, .fields = orthographic, .vital = true},
    Field{.name = "extras", .type = Type::object, .fields = cameraExtras, .anyType = true},
};
constexpr std::array spot{
    Field{.name = "innerConeAngle", .min = 0, .max = halfPi},
    Field{.name = "outerConeAngle", .min = 0, .max = halfPi},
};
constexpr std::array lightExtras{
    Field{.name = "radius", .min = 0},  // Reflet's own: Lamp::radius
};
constexpr std::array light{
    Field{.name = "name", .type = Type::text},
    Field{.name = "color", .array = true, .items = 3, .min = 0},
    Field{.name = "intensity", .min = 0, .max = largestRadiance},
    Field{.name = "type", .type = Type::text, .required = true, .words = lightTypes},
    Field{.name = "range", .min = 1e-6, .clamps = false},
    Field{.name = "spot", .type = Type::object, .fields = spot, .vital = true},
    Field{.name = "extras", .type = Type::object, .fields = lightExtras, .anyType = true},
};
constexpr std::array lights{
    Field{.name = "lights",
          .type = Type::object,
          .required = true,
          .array = true,
          .fields = light,
          .standIn = lightStandIn},
};
constexpr std::array variant{
    Field{.name = "name", .type = Type::text, .required = true},
};
constexpr std::array variants{
    Field{.name = "variants", .type = Type::object, .required = true, .array = true, .fields = variant},
};
constexpr std::array documentExtensions{
    Field{.name = "KHR_materials_variants", .type = Type::object, .fields = variants},
    Field{.name = "KHR_lights_punctual", .type = Type::object, .fields = lights},
};

// What is referred to comes first, so that references to invalid elements are found.
constexpr std::array root{
    Field{.name = "asset", .type = Type::object, .required = true, .fields = asset},
    Field{.name = "extensionsUsed", .type = Type::text, .array = true, .without = noExtension, .standIn = ""},
    Field{.name = "extensionsRequired", .type = Type::text, .array = true, .without = noExtension, .standIn = ""},
    Field{.name = "buffers", .type = Type::object, .array = true, .fields = buffer, .standIn = bufferStandIn},
    Field{.name = "bufferViews", .type = Type::object, .array = true, .fields = bufferView, .standIn = viewStandIn},
    Field{.name = "accessors", .type = Type::object, .array = true, .fields = accessor, .standIn = accessorStandIn},
    Field{.name = "images", .type = Type::object, .array = true, .fields = image, .standIn = "{}"},
    Field{.name = "samplers", .type = Type::object, .array = true, .fields = sampler, .standIn = "{}"},
    Field{.name = "textures", .type = Type::object, .array = true, .fields = texture, .standIn = "{}"},
    Field{.name = "materials", .type = Type::object, .array = true, .fields = material, .standIn = "{}"},
    Field{.name = "extensions", .type = Type::object, .fields = documentExtensions},
    Field{.name = "meshes", .type = Type::object, .array = true, .fields = mesh, .standIn = meshStandIn},
    Field{.name = "cameras", .type = Type::object, .array = true, .fields = camera, .standIn = cameraStandIn},
    Field{.name = "skins", .type = Type::object, .array = true, .fields = skin, .standIn = skinStandIn},
    Field{.name = "nodes", .type = Type::object, .array = true, .fields = node, .without = noNode, .standIn = "{}"},
    Field{.name = "animations",
          .type = Type::object,
          .array = true,
          .fields = animation,
          .without = noAnimation,
          .standIn = animationStandIn},
    Field{.name = "scenes", .type = Type::object, .array = true, .fields = scene, .without = noScene, .standIn = "{}"},
    Field{.name = "scene", .type = Type::index, .refersTo = "scenes"},
};

}  // namespace

std::span<const Field> document() {
    return root;
}

bool knownAttribute(std::string_view name) {
    return std::find(attributes.begin(), attributes.end(), name) != attributes.end() ||
           std::ranges::any_of(attributeSets, [&](std::string_view set) { return attributeSet(name, set) >= 0; });
}

int attributeSet(std::string_view name, std::string_view set) {
    constexpr size_t mostDigits = 3;
    if (!set.ends_with('_') || name.size() <= set.size() || !name.starts_with(set) ||
        name.size() > set.size() + mostDigits) {
        return -1;
    }
    int number = 0;
    for (const char digit : name.substr(set.size())) {
        if (digit < '0' || digit > '9') {
            return -1;
        }
        number = 10 * number + (digit - '0');
    }
    return number;
}

}  // namespace reflet::gltf_schema
