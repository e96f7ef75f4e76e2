// Reads the keyframes of one channel of a glTF animation.
#pragma once

#include "scene/animation.h"
#include "scene/gltf/document.h"

#include <optional>
#include <string>

namespace reflet {

struct GltfChannelSource {
    const tinygltf::Animation& animation;
    const tinygltf::AnimationChannel& channel;
    std::string part;         ///< JSON path of the channel
    size_t morphTargets = 0;  ///< of the node's mesh
    int components = 0;       ///< of a property; 0: the channel's path says what it animates
};

/// The node is left for the caller to set. nullopt, with a warning, if the property is not supported. Throws Error.
std::optional<Channel> readGltfChannel(const GltfDocument& document, const GltfChannelSource& source,
                                       GltfReport& report);

}  // namespace reflet
