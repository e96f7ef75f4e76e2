// The properties of a glTF document that the loader reads, as tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace reflet::gltf_schema {

enum class Type : uint8_t { boolean, integer, index, number, text, object, indexMap };

/// One property of an object.
struct Field {
    const char* name;
    Type type = Type::number;
    bool required = false;
    bool array = false;                               ///< an array of the type
    size_t items = 0;                                 ///< of an array; 0: any number
    const char* refersTo = nullptr;                   ///< index, indexMap: the array that it indexes
    double min = -std::numeric_limits<float>::max();  ///< every number must fit a float
    double max = std::numeric_limits<float>::max();
    uint64_t multipleOf = 1;                    ///< integer
    std::span<const std::string_view> words{};  ///< text: allowed values; empty: any
    std::span<const uint64_t> numbers{};        ///< integer: allowed values; empty: any
    std::span<const Field> fields{};            ///< object
    bool anyType = false;                       ///< may have any type; ignored unless an object

    // What an invalid value does unless the loader is strict. If `required`: it makes the object invalid.
    bool vital = false;  ///< the same, although it may be missing
    bool clamps = true;  ///< number: is clamped to min..max, unless that limit is the largest float
    /// Consequence of leaving the value out, or one element of an array that has a standIn. Null: "its default will be
    /// used"; where there is a standIn: other objects refer to the elements, and tell their own consequences.
    const char* without = nullptr;
    /// Array: JSON that replaces an invalid element, so that the others keep their indices; "": the element is left
    /// out. Null: the array is invalid.
    const char* standIn = nullptr;
};

/// The document itself.
std::span<const Field> document();

/// Whether the loader reads the attribute of this name, of vertices or of instances.
bool knownAttribute(std::string_view name);

/// The number of an attribute of which a vertex may have several: 2 of "TEXCOORD_2" with the set "TEXCOORD_". < 0: the
/// attribute is none of that set.
int attributeSet(std::string_view name, std::string_view set);

constexpr auto knownExtensions = std::to_array<std::string_view>({
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_animation_pointer",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "KHR_node_visibility",
    "KHR_meshopt_compression",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_iridescence",
    "KHR_materials_diffuse_transmission",
});

/// Extensions that do not change the image: what they describe is not drawn, or they choose among equals.
constexpr auto harmlessExtensions = std::to_array<std::string_view>({
    "AGI_articulations",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "FB_ngon_encoding",
    "KHR_audio",
    "KHR_audio_emitter",
    "KHR_interactivity",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_lod",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic",
    "MSFT_texture_dds",
});

}  // namespace reflet::gltf_schema
