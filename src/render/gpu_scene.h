// A scene on the device: vertex buffers, textures with mips, materials, lamps; made once, drawn every frame.
#pragma once

#include "gpu/device.h"
#include "gpu/resource.h"
#include "render/draw_list.h"
#include "render/lamps.h"
#include "render/material.h"
#include "render/skin/skin.h"
#include "scene/scene.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reflet {

class GpuScene {
public:
    /// Uploads everything. `warn` hears of what does not fit (more than maxLamps lamps: the weakest are left out).
    GpuScene(gpu::Device& device, const Scene& scene, const std::function<void(const std::string&)>& warn);
    ~GpuScene();
    GpuScene(const GpuScene&) = delete;
    GpuScene& operator=(const GpuScene&) = delete;

    /// anisotropy: texture samples along a slanted surface, at most. mips: false: only the finest level is read. No
    /// frame that draws the scene may be in flight.
    void setTextureFilter(uint32_t anisotropy, bool mips);

    /// Puts everything where it is now, and was in the last frame: draws, lamps, cameras of live pictures. What is
    /// skinned follows with skin(). No frame that draws the scene may be in flight.
    void pose(const Scene& scene, const ScenePose& now, const ScenePose& before);
    /// Records the pass that bends skinned meshes as of pose().
    void skin(gpu::Frame& f) const;
    [[nodiscard]] bool hasSkins() const { return !skinned_.empty(); }

    /// Pixels from top to bottom of live pictures. No frame that draws the scene may be in flight.
    void setLiveHeight(uint32_t pixels);

    /// A picture for each camera that a material shows.
    struct LivePicture {
        Camera camera;         ///< as the scene has it
        Camera posed;          ///< where it is now
        gpu::Texture texture;  ///< RGBA16F, 16:9
        bool fresh = true;     ///< nothing has been drawn in it yet
    };
    [[nodiscard]] std::vector<LivePicture>& livePictures() { return live_; }

    [[nodiscard]] const DrawList& draws() const { return draws_; }
    [[nodiscard]] const LampBlock& lamps() const { return lamps_; }
    /// For rays: VertexAttributes and indices of all meshes, mesh after mesh; indices count within their mesh.
    [[nodiscard]] gpu::BufferView attributes() const { return attributes_.view(); }
    [[nodiscard]] gpu::BufferView indices() const { return indices_.view(); }

private:
    struct MeshRange {
        uint32_t firstIndex;
        int32_t firstVertex;
    };

    void uploadMeshes(const Scene& scene);
    void uploadMaterials(const Scene& scene, const std::function<void(const std::string&)>& warn);
    std::optional<size_t> livePictureOf(const Scene& scene, const Material& material,
                                        const std::function<void(const std::string&)>& warn);
    void addLamps(const Scene& scene, const std::function<void(const std::string&)>& warn);
    void addDraws(const Scene& scene);
    void addSkinned(const Scene& scene, std::vector<vec3>& positions, std::vector<VertexAttributes>& attributes);
    gpu::Image texture(const Scene& scene, int32_t image, bool srgb);
    // What a material's set binds.
    struct MaterialBinding {
        VkDescriptorSet set = VK_NULL_HANDLE;
        VkDeviceSize offset = 0;  ///< of its MaterialParams in materials_
        std::array<gpu::SamplerInfo, slotCount> samplers;
        std::array<VkImageView, slotCount> views{};
        std::optional<size_t> live;  ///< number of the picture in the emissive slot
    };
    void bindMaterial(const Scene& scene, const Material& material, MaterialBinding& binding);
    void writeMaterialSet(const MaterialBinding& binding);

    gpu::Device& device_;
    gpu::Buffer positions_;          ///< of meshes, then of instances with a skin
    gpu::Buffer previousPositions_;  ///< as many; none without skins
    gpu::Buffer attributes_;         ///< as many
    gpu::Buffer indices_;
    gpu::Buffer materials_;
    std::vector<MeshRange> ranges_;
    SkinnedVertices skinned_;
    std::map<size_t, int32_t> skinnedFirst_;                     ///< first vertex of an instance with a skin
    std::map<size_t, std::vector<Aabb>> skinnedBounds_;          ///< by joint, of an instance with a skin
    std::map<std::pair<int32_t, bool>, gpu::Texture> textures_;  ///< by image and sRGB
    VkDescriptorSetLayout materialLayout_ = VK_NULL_HANDLE;
    VkDescriptorPool materialPool_ = VK_NULL_HANDLE;
    std::vector<MaterialBinding> materialBindings_;
    std::vector<LivePicture> live_;
    uint32_t anisotropy_ = 1;
    bool mips_ = true;
    LampBlock lamps_{};
    std::vector<size_t> lampSources_;  ///< indices into Scene::lamps
    std::optional<double> posedTime_;  ///< that the draws are as of
    DrawList draws_{.version = 1};
};

}  // namespace reflet
