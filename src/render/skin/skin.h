// Skinned meshes: a pass bends them into vertex buffers of their own, as they are in this frame and as they were in the
// last one, so that whoever draws knows nothing of skins. Linear blend skinning (Magnenat-Thalmann, Laperrière and
// Thalmann, Joint-Dependent Local Deformations for Hand Animation and Object Grasping, 1988), up to four joints a
// vertex. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_SKIN_H
#define REFLET_RENDER_SKIN_H

#include "base/shared.h"

SHARED_BEGIN

// What one vertex is made of. Vertices and joints count over all meshes and all skins.
struct SkinnedVertex {
    uint source;  // the vertex as its mesh has it; its own number is SkinParams.firstVertex and on
    uint joints[4];
    vec4 weights;
};

struct SkinParams {
    uint firstVertex;  // of the skinned ones, which are one after another
    uint count;
    uint jointCount;  // of all skins: the joints of now, then as many of the last frame
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "scene/pose.h"

#include <vector>

namespace reflet {

/// The skinned vertices of a scene, and the joints that move them.
class SkinnedVertices {
public:
    /// Adds the vertices of an instance with a skin. Vertices must be added in the order of their numbers.
    void add(const Scene& scene, const Instance& instance, uint32_t firstSource);
    /// firstVertex: number of the first that was added. After all were.
    void upload(gpu::Device& device, const Scene& scene, uint32_t firstVertex);

    [[nodiscard]] bool empty() const { return count_ == 0; }

    /// Joints of now and of the last frame. No frame that skins may be in flight.
    void pose(const ScenePose& now, const ScenePose& before);

    struct Buffers {
        gpu::BufferView positions;          ///< vec3
        gpu::BufferView previousPositions;  ///< vec3
        gpu::BufferView attributes;         ///< VertexAttributes
    };
    /// Records the pass; what follows in this frame and in later ones may draw.
    void record(gpu::Frame& f, const Buffers& vertices) const;

private:
    uint32_t firstVertex_ = 0;
    uint32_t count_ = 0;
    uint32_t jointCount_ = 0;
    std::vector<SkinnedVertex> added_;
    gpu::Buffer vertices_;
    gpu::Buffer joints_;  ///< mat4x3, host visible
};

}  // namespace reflet
#endif

#endif
