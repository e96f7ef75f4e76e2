// A scene on the device: vertex buffers, textures with mips, materials, lamps. Created once, drawn every frame.
#pragma once

#include "device/device.h"
#include "effects/lamps.h"
#include "gpu/resource.h"
#include "renderer/draw_list.h"
#include "renderer/emitter_lamps.h"
#include "renderer/material.h"
#include "renderer/skin/skin.h"
#include "scene/scene.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reflet {

/// How textures of materials are filtered, as in MaterialsSettings.
struct TextureFilter {
    uint32_t anisotropy = 1;
    bool mips = true;
    float mipBias = 0.0F;

    bool operator==(const TextureFilter&) const = default;
};

/// Shader parameters of a lamp, without shadow.
LampParams lampParams(const Lamp& lamp);

class GpuScene {
public:
    /// Uploads everything. `warn` receives messages about parts left out (of more than maxLamps lamps, the weakest).
    GpuScene(gpu::Device& device, const Scene& scene, const std::function<void(const std::string&)>& warn);
    ~GpuScene();
    GpuScene(const GpuScene&) = delete;
    GpuScene& operator=(const GpuScene&) = delete;

    /// Sets the filtering of material textures. No frame that draws the scene may be in flight.
    void setTextureFilter(const TextureFilter& filter);

    /// Sets the current and the previous pose of draws, lamps and live cameras. Deformed vertices follow with skin().
    /// No frame that draws the scene may be in flight.
    void pose(const Scene& scene, const ScenePose& now, const ScenePose& before);
    /// Records the skinning pass for the pose set by pose().
    void skin(gpu::PassList& f) const;
    [[nodiscard]] bool hasSkins() const { return !skinned_.empty(); }

    /// Height of live camera images in pixels. No frame that draws the scene may be in flight.
    void setLiveHeight(uint32_t pixels);

    /// The image of a camera that a material shows.
    struct LivePicture {
        Camera camera;         ///< as in the scene
        Camera posed;          ///< at the current pose
        gpu::Texture texture;  ///< RGBA16F, 16:9
        bool fresh = true;     ///< not yet rendered
    };
    [[nodiscard]] std::vector<LivePicture>& livePictures() { return live_; }

    [[nodiscard]] const DrawList& draws() const { return draws_; }
    /// emitters: includes the lamps that replace small bright emitters.
    [[nodiscard]] LampBlock lamps(bool emitters) const;
    [[nodiscard]] const EmitterLamps& emitters() const { return *emitters_; }
    /// Shader parameters of a material. index: in the scene.
    [[nodiscard]] MaterialParams paramsOf(const Material& material, uint32_t index) const;
    /// For ray hits: VertexAttributes and indices of all meshes, concatenated; indices are relative to their mesh.
    [[nodiscard]] gpu::BufferView attributes() const { return attributes_.view(); }
    [[nodiscard]] gpu::BufferView indices() const { return indices_.view(); }

private:
    explicit GpuScene(gpu::Device& device) : device_(device) {}

    struct MeshRange {
        uint32_t firstIndex;
        int32_t firstVertex;
    };

    void uploadMeshes(const Scene& scene);
    void uploadMaterials(const Scene& scene, const std::function<void(const std::string&)>& warn);
    std::optional<size_t> livePictureOf(const Scene& scene, const Material& material,
                                        const std::function<void(const std::string&)>& warn);
    void poseMaterial(const Material& material, uint32_t index);
    void addLamps(const Scene& scene, const std::function<void(const std::string&)>& warn);
    void addDraws(const Scene& scene);
    void addLevels(const Scene& scene, std::vector<uint32_t>& indices);
    void addSkinned(const Scene& scene, std::vector<vec3>& positions, std::vector<VertexAttributes>& attributes);
    gpu::Image texture(const Scene& scene, int32_t image, bool srgb);
    // The contents of a material's descriptor set.
    struct MaterialBinding {
        VkDescriptorSet set = VK_NULL_HANDLE;
        VkDeviceSize offset = 0;  ///< offset of its MaterialParams in materials_
        std::array<gpu::SamplerInfo, slotCount> samplers;
        std::array<VkImageView, slotCount> views{};
        std::optional<size_t> live;  ///< index of the live image in the emissive slot
    };
    void bindMaterial(const Scene& scene, const Material& material, MaterialBinding& binding);
    void writeMaterialSet(const MaterialBinding& binding);

    gpu::Device& device_;
    gpu::Buffer positions_;          ///< vertices of meshes, then of deformed instances
    gpu::Buffer previousPositions_;  ///< same count; none without deformed instances
    gpu::Buffer attributes_;         ///< same count
    gpu::Buffer indices_;
    gpu::Buffer materials_;  ///< mapped if materials are animated
    std::vector<MeshRange> ranges_;
    std::vector<std::vector<Aabb>> pieces_;       ///< meshPieces of every mesh
    std::vector<std::vector<DrawLevel>> levels_;  ///< levels of detail of every mesh
    SkinnedVertices skinned_;
    std::map<size_t, int32_t> skinnedFirst_;                     ///< first vertex of a deformed instance
    std::map<size_t, std::vector<JointBounds>> skinnedBounds_;   ///< bounds per joint of a deformed instance
    std::map<std::pair<int32_t, bool>, gpu::Texture> textures_;  ///< by image and sRGB
    VkDescriptorSetLayout materialLayout_ = VK_NULL_HANDLE;
    VkDescriptorPool materialPool_ = VK_NULL_HANDLE;
    std::vector<MaterialBinding> materialBindings_;
    std::vector<LivePicture> live_;
    TextureFilter filter_;
    LampBlock lamps_{};
    std::optional<EmitterLamps> emitters_;
    std::vector<size_t> lampSources_;  ///< indices into Scene::lamps
    std::optional<double> posedTime_;  ///< time of the current pose
    DrawList draws_{.version = 1};
};

}  // namespace reflet
