// Converts materials of a glTF file and their textures. Only materials that are used are converted.
#pragma once

#include "scene/gltf/document.h"
#include "scene/gltf/image.h"
#include "scene/scene.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace reflet {

class GltfMaterials {
public:
    /// All three must outlive this object.
    GltfMaterials(const GltfDocument& document, Scene& scene, GltfReport& report)
        : document_(document), scene_(scene), report_(report) {}

    /// Index into Scene::materials of the material with this index in the file; < 0: glTF's default material. lit:
    /// false for points and lines without normals, which show their base colour.
    uint32_t use(int material, bool lit = true);

    /// Indices into Scene::materials of what `use` made of the file's material.
    [[nodiscard]] std::vector<uint32_t> materialsOf(int material) const;

    /// The file's sets of texture coordinates that are the first and the second of a vertex of this material, an index
    /// into Scene::materials.
    [[nodiscard]] const std::array<uint32_t, 2>& uvSets(uint32_t material) const { return uvSets_[material]; }

private:
    Material convert(int material);
    TextureSlot slot(int texture, int uvSet, const tinygltf::ExtensionMap& extensions);
    TextureSlot slotOf(const tinygltf::Value& object, const std::string& name);
    void readSpecular(Material& material, const tinygltf::ExtensionMap& extensions, const std::string& part);
    Transmission transmissionOf(const tinygltf::ExtensionMap& extensions, const std::string& part);
    Sheen sheenOf(const tinygltf::ExtensionMap& extensions);
    Anisotropy anisotropyOf(const tinygltf::ExtensionMap& extensions);
    Iridescence iridescenceOf(const tinygltf::ExtensionMap& extensions);
    DiffuseTransmission diffuseTransmissionOf(const tinygltf::ExtensionMap& extensions);
    Clearcoat clearcoatOf(const tinygltf::ExtensionMap& extensions);
    static void transformUv(TextureSlot& slot, const tinygltf::Value& transform);
    int32_t useImage(int image);
    /// Index of the file's image that the texture shows; < 0, with a warning: none that can be decoded.
    int imageOf(const tinygltf::Texture& texture, const std::string& part);
    int32_t useSampler(int sampler);
    /// Numbers the sets of texture coordinates that the material uses 0 and 1, and tells which these are in the file.
    std::array<uint32_t, 2> chooseUvSets(Material& material, const std::string& part);
    void readSpecularGlossiness(Material& material, const tinygltf::Value& extension);
    int32_t convertGlossiness(int32_t image, float glossiness);

    const GltfDocument& document_;
    Scene& scene_;
    GltfReport& report_;
    std::map<std::pair<int, bool>, uint32_t> materials_;  ///< from the file's index, and lit, to the scene's
    std::map<int, int32_t> images_;
    std::map<GltfImagePlace, int32_t> places_;  ///< of decoded images, to the scene's index
    std::map<int, int32_t> samplers_;
    std::map<std::pair<int32_t, float>, int32_t> glossiness_;  ///< converted images
    std::vector<std::array<uint32_t, 2>> uvSets_;              ///< per material of the scene
};

}  // namespace reflet
