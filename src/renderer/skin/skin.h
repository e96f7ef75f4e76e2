// Skinned and morphed meshes: a pass writes their vertices for this frame and the last one to vertex buffers, so that
// draws need no knowledge of skins and morph targets. Weighted sums of morph targets, then linear blend skinning
// (Magnenat-Thalmann, Laperrière and Thalmann, Joint-Dependent Local Deformations for Hand Animation and Object
// Grasping, 1988), any number of joints a vertex. Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_SKIN_H
#define REFLET_RENDERER_SKIN_H

#include "base/shared.h"

SHARED_BEGIN

// Skinning inputs of one vertex. Indices count over all meshes and all skins.
struct SkinnedVertex {
    uint source;      // vertex in bind pose; the skinned vertex i is vertex SkinParams.firstVertex + i
    uint firstJoint;  // index of its first SkinnedWeight
    uint jointCount;  // 0: only morphed, so it stays in object space
};

struct SkinnedWeight {
    uint joint;
    float weight;  // the weights of a vertex sum to 1
};

// The morph deltas of one vertex. Indices count over all meshes and instances.
struct MorphedVertex {
    uint firstDelta;
    uint deltaCount;
    uint firstWeight;  // first morph weight of its instance
};

struct SkinParams {
    uint firstVertex;  // first skinned vertex; they are contiguous
    uint count;
    uint jointCount;   // joints of all skins; the buffer has the current ones, then those of the last frame
    uint weightCount;  // morph weights of all instances, in the same way
};

SHARED_END

#ifdef __cplusplus

#include "device/device.h"
#include "gpu/pass_list.h"
#include "scene/pose.h"

#include <map>
#include <vector>

namespace reflet {

/// The skinned and morphed vertices of a scene, and the joints and weights that move them.
class SkinnedVertices {
public:
    /// Adds the vertices of a deformed instance. Vertices must be added in the order of their indices.
    void add(const Scene& scene, size_t instance, uint32_t firstSource);
    /// Call after all vertices were added. firstVertex: index of the first skinned vertex.
    void upload(gpu::Device& device, const Scene& scene, uint32_t firstVertex);

    [[nodiscard]] bool empty() const { return count_ == 0; }

    /// Sets the joints and weights of this frame and the last. No frame that uses them may be in flight.
    void pose(const ScenePose& now, const ScenePose& before);

    struct Buffers {
        gpu::BufferView positions;          ///< vec3
        gpu::BufferView previousPositions;  ///< vec3
        gpu::BufferView attributes;         ///< VertexAttributes
    };
    /// Records the pass; later passes of this and following frames can draw the vertices.
    void record(gpu::PassList& f, const Buffers& vertices) const;

private:
    void addMorph(const Scene& scene, size_t instance);
    void uploadMorphs(gpu::Device& device);

    uint32_t firstVertex_ = 0;
    uint32_t count_ = 0;
    uint32_t jointCount_ = 0;
    uint32_t weightCount_ = 0;
    std::vector<SkinnedVertex> added_;
    std::vector<SkinnedWeight> addedWeights_;
    std::vector<MorphedVertex> addedMorphs_;  ///< one per added vertex; those without morph targets have no deltas
    std::vector<MorphDelta> addedDeltas_;
    std::map<uint32_t, uint32_t> firstDelta_;  ///< first morph delta of each mesh
    std::vector<size_t> morphed_;              ///< instances, in the order of their weights
    gpu::Buffer vertices_;
    gpu::Buffer jointWeights_;
    gpu::Buffer joints_;   ///< mat4x3, host visible
    gpu::Buffer morphs_;   ///< these three: only with morph targets
    gpu::Buffer deltas_;   ///< MorphDelta
    gpu::Buffer weights_;  ///< float, host visible
};

}  // namespace reflet
#endif

#endif
