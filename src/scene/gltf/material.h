// Converts materials of a glTF file and their textures. Only materials that are used are converted.
#pragma once

#include "scene/gltf/document.h"
#include "scene/gltf/image.h"
#include "scene/scene.h"

#include <map>

namespace reflet {

class GltfMaterials {
public:
    /// All three must outlive this object.
    GltfMaterials(const GltfDocument& document, Scene& scene, GltfReport& report)
        : document_(document), scene_(scene), report_(report) {}

    /// Index into Scene::materials of the material with this index in the file; < 0: glTF's default material.
    uint32_t use(int material);

private:
    Material convert(int material);
    TextureSlot slot(int texture, int uvSet, const tinygltf::ExtensionMap& extensions, const std::string& part);
    TextureSlot slotOf(const tinygltf::Value& object, const std::string& name, const std::string& part);
    void readSpecular(Material& material, const tinygltf::ExtensionMap& extensions, const std::string& part);
    Transmission transmissionOf(const tinygltf::ExtensionMap& extensions, const std::string& part);
    Sheen sheenOf(const tinygltf::ExtensionMap& extensions, const std::string& part);
    Anisotropy anisotropyOf(const tinygltf::ExtensionMap& extensions, const std::string& part);
    Clearcoat clearcoatOf(const tinygltf::ExtensionMap& extensions, const std::string& part);
    void transformUv(TextureSlot& slot, const tinygltf::Value& transform, const std::string& part);
    int32_t useImage(int image);
    /// Index of the file's image that the texture shows; < 0, with a warning: none that can be decoded.
    int imageOf(const tinygltf::Texture& texture, const std::string& part);
    int32_t useSampler(int sampler);
    void setUvSet(TextureSlot& slot, int uvSet, const std::string& part);

    const GltfDocument& document_;
    Scene& scene_;
    GltfReport& report_;
    std::map<int, uint32_t> materials_;  ///< from the file's index to the scene's
    std::map<int, int32_t> images_;
    std::map<GltfImagePlace, int32_t> places_;  ///< of decoded images, to the scene's index
    std::map<int, int32_t> samplers_;
};

}  // namespace reflet
