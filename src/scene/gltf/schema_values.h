// Values that the tables of a glTF document's properties refer to: what is allowed, what a value that is left out does,
// and what replaces an invalid element.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace reflet::gltf_schema {

constexpr double maxInt = 2147483647.0;  // for values that tinygltf stores in an int
constexpr double halfPi = 1.5707963705;  // rounded up to float

constexpr std::array<uint64_t, 6> componentTypes{5120, 5121, 5122, 5123, 5125, 5126};
constexpr std::array<uint64_t, 3> indexTypes{5121, 5123, 5125};
constexpr std::array<uint64_t, 2> magFilters{9728, 9729};
constexpr std::array<uint64_t, 6> minFilters{9728, 9729, 9984, 9985, 9986, 9987};
constexpr std::array<uint64_t, 3> wraps{33071, 33648, 10497};
constexpr std::array<std::string_view, 7> accessorTypes{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr std::array<std::string_view, 3> alphaModes{"OPAQUE", "MASK", "BLEND"};
constexpr std::array<std::string_view, 2> cameraTypes{"perspective", "orthographic"};
constexpr std::array<std::string_view, 3> lightTypes{"directional", "point", "spot"};
constexpr std::array<std::string_view, 7> attributes{"POSITION",    "NORMAL",   "TANGENT", "COLOR_0",
                                                     "TRANSLATION", "ROTATION", "SCALE"};
constexpr std::array<std::string_view, 3> attributeSets{"TEXCOORD_", "JOINTS_", "WEIGHTS_"};  // with a number
constexpr std::array<std::string_view, 3> meshoptModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<std::string_view, 5> meshoptFilters{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"};
constexpr std::array<std::string_view, 3> interpolations{"STEP", "LINEAR", "CUBICSPLINE"};

// Consequences of leaving out invalid values.
constexpr const char* noTexture = "the texture will be left out";
constexpr const char* noAttribute = "the attribute will be missing";
constexpr const char* noTargets = "the mesh will keep its base shape";
constexpr const char* noPrimitive = "the primitive will not be drawn";
constexpr const char* noMesh = "the mesh will not be drawn";
constexpr const char* noSkin = "the mesh will not be deformed";
constexpr const char* noNode = "the node will not be drawn";
constexpr const char* noScene = "the scene will be empty";
constexpr const char* noCamera = "the camera will be missing";
constexpr const char* noLamp = "the lamp will be missing";
constexpr const char* noAnimation = "the animation will be missing";
constexpr const char* noChannel = "the channel will be ignored";
constexpr const char* noExtension = "the extension will be ignored";

// Replace invalid elements. Nothing refers to them, and the loader skips primitives, channels and samplers like these.
constexpr const char* bufferStandIn = R"({"byteLength": 1})";
constexpr const char* viewStandIn = R"({"buffer": 0, "byteLength": 1})";
constexpr const char* accessorStandIn = R"({"componentType": 5126, "count": 1, "type": "SCALAR"})";
constexpr const char* primitiveStandIn = R"({"attributes": {}, "mode": -1})";
constexpr const char* meshStandIn = R"({"primitives": []})";
constexpr const char* cameraStandIn = R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 1}})";
constexpr const char* lightStandIn = R"({"type": "point"})";
constexpr const char* skinStandIn = R"({"joints": []})";
constexpr const char* channelStandIn = R"({"sampler": 0, "target": {"path": ""}})";
constexpr const char* samplerStandIn = R"({"input": -1, "output": -1})";
constexpr const char* animationStandIn = R"({"channels": [], "samplers": []})";

}  // namespace reflet::gltf_schema
