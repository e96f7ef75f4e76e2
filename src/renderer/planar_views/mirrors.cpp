// Finds planar surfaces in a scene and selects the mirrors that are largest on screen.
#include "renderer/planar_views/mirrors.h"

#include "base/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace reflet {

namespace {

constexpr size_t mostPieces = 16;  // per instance; an instance with more planes counts as curved
constexpr float flatness = 1e-4F;  // largest distance of vertices from their plane, relative to the instance's size
constexpr float sameDirection = 0.9999F;  // cosine
constexpr float smallestArea = 1e-4F;     // share of the screen

void setAxes(FlatPiece& piece) {
    const vec3 n(piece.plane);
    const vec3 upward = std::abs(n.y) < 0.99F ? vec3(0, 1, 0) : vec3(0, 0, -1);
    piece.up = glm::normalize(upward - n * glm::dot(upward, n));
    piece.right = glm::cross(piece.up, n);
}

bool liesIn(const FlatPiece& piece, const vec3& normal, const std::array<vec3, 3>& corners) {
    return glm::dot(vec3(piece.plane), normal) > sameDirection && std::ranges::all_of(corners, [&](const vec3& p) {
               return std::abs(glm::dot(piece.plane, vec4(p, 1.0F))) <= piece.tolerance;
           });
}

void extend(FlatPiece& piece, const vec3& p) {
    const vec2 at(glm::dot(piece.right, p), glm::dot(piece.up, p));
    piece.low = glm::min(piece.low, at);
    piece.high = glm::max(piece.high, at);
}

// 1 where nothing is reflected.
float meanRoughness(const Scene& scene, const Material& material) {
    if (material.unlit || (material.metallic == 0.0F && material.specular == 0.0F)) {
        return 1.0F;
    }
    const int32_t image = material.metallicRoughnessTexture.image;
    if (image < 0) {
        return material.roughness;
    }
    const std::vector<uint8_t>& rgba = scene.images.at(static_cast<size_t>(image)).rgba;
    double sum = 0.0;
    for (size_t i = 1; i < rgba.size(); i += 4) {
        sum += rgba[i];
    }
    return material.roughness * static_cast<float>(sum / 255.0 / std::max<double>(1.0, double(rgba.size()) / 4.0));
}

// Of the parts that a texture scales, in linear light.
vec3 meanColor(const Scene& scene, int32_t image, bool srgb) {
    if (image < 0) {
        return vec3(1.0F);
    }
    const std::vector<uint8_t>& rgba = scene.images.at(static_cast<size_t>(image)).rgba;
    std::array<float, 256> values{};
    for (size_t i = 0; i < values.size(); ++i) {
        const float encoded = static_cast<float>(i) / 255.0F;
        values[i] = srgb ? decodeSrgb(encoded) : encoded;
    }
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i + 3 < rgba.size(); i += 4) {
        sum += vec3(values[rgba[i]], values[rgba[i + 1]], values[rgba[i + 2]]);
    }
    return vec3(sum / std::max<double>(1.0, static_cast<double>(rgba.size() / 4)));
}

vec3 meanReflectance(const Scene& scene, const Material& material) {
    const float metallic = material.metallic * meanColor(scene, material.metallicRoughnessTexture.image, false).z;
    const int32_t image = metallic > 0.0F ? material.baseColorTexture.image : -1;
    const vec3 base = vec3(material.baseColor) * meanColor(scene, image, true);
    return glm::mix(0.04F * material.specular * material.specularColor, base, metallic);
}

/// Empty if the triangles lie in more than mostPieces planes.
std::vector<FlatPiece> piecesOf(const Mesh& mesh, const mat4& objectToWorld) {
    const float mirrored = glm::determinant(mat3(objectToWorld)) < 0.0F ? -1.0F : 1.0F;
    const float tolerance =
        std::max(flatness * glm::length(transformed(mesh.bounds, objectToWorld).size()), flatness * flatness);
    std::vector<FlatPiece> pieces;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<vec3, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] = vec3(objectToWorld * vec4(mesh.positions.at(mesh.indices[i + k]), 1.0F));
        }
        const vec3 across = mirrored * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!(glm::length(across) > tolerance * tolerance)) {
            continue;  // degenerate triangle
        }
        const vec3 normal = glm::normalize(across);
        auto piece = std::ranges::find_if(pieces, [&](const FlatPiece& p) { return liesIn(p, normal, corners); });
        if (piece == pieces.end()) {
            if (pieces.size() == mostPieces) {
                return {};
            }
            piece = pieces.insert(pieces.end(), FlatPiece{});
            piece->plane = vec4(normal, -glm::dot(normal, corners[0]));
            piece->tolerance = tolerance;
            setAxes(*piece);
            piece->low = vec2(std::numeric_limits<float>::max());
            piece->high = -piece->low;
        }
        std::ranges::for_each(corners, [&](const vec3& p) { extend(*piece, p); });
        piece->area += 0.5F * glm::length(across);
    }
    return pieces;
}

bool samePlane(const Mirror& mirror, const FlatPiece& piece) {
    const vec3 middle(vec3(piece.plane) * -piece.plane.w + piece.right * 0.5F * (piece.low.x + piece.high.x) +
                      piece.up * 0.5F * (piece.low.y + piece.high.y));
    return glm::dot(vec3(mirror.plane), vec3(piece.plane)) > sameDirection &&
           std::abs(glm::dot(mirror.plane, vec4(middle, 1.0F))) <= mirror.tolerance + piece.tolerance;
}

using ClipPolygon = std::vector<vec4>;  // clip space

// Clips the polygon to the half-space with dot(plane, p) >= 0. (Sutherland and Hodgman, Reentrant Polygon Clipping,
// 1974)
ClipPolygon cut(const ClipPolygon& polygon, const vec4& plane) {
    ClipPolygon result;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const vec4& a = polygon[i];
        const vec4& b = polygon[(i + 1) % polygon.size()];
        const float insideA = glm::dot(plane, a);
        const float insideB = glm::dot(plane, b);
        if (insideA >= 0.0F) {
            result.push_back(a);
        }
        if ((insideA >= 0.0F) != (insideB >= 0.0F)) {
            result.push_back(glm::mix(a, b, insideA / (insideA - insideB)));
        }
    }
    return result;
}

// Adds the piece's visible part on screen to the mirror's area and bounds.
void addOnScreen(Mirror& mirror, const FlatPiece& piece, const mat4& worldToClip) {
    ClipPolygon polygon;
    for (const vec2 corner :
         {piece.low, vec2(piece.high.x, piece.low.y), piece.high, vec2(piece.low.x, piece.high.y)}) {
        const vec3 p = vec3(piece.plane) * -piece.plane.w + piece.right * corner.x + piece.up * corner.y;
        polygon.push_back(worldToClip * vec4(p, 1.0F));
    }
    for (const vec4 side :
         {vec4(0, 0, -1, 1), vec4(1, 0, 0, 1), vec4(-1, 0, 0, 1), vec4(0, 1, 0, 1), vec4(0, -1, 0, 1)}) {
        polygon = cut(polygon, side);
    }
    float twice = 0.0F;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const vec4& next = polygon[(i + 1) % polygon.size()];
        const vec2 a = 0.5F + 0.5F * vec2(polygon[i]) / polygon[i].w;
        const vec2 b = 0.5F + 0.5F * vec2(next) / next.w;
        twice += a.x * b.y - a.y * b.x;
        mirror.uvLow = glm::min(mirror.uvLow, glm::clamp(a, 0.0F, 1.0F));
        mirror.uvHigh = glm::max(mirror.uvHigh, glm::clamp(a, 0.0F, 1.0F));
    }
    mirror.area += 0.5F * std::abs(twice);
}

void addPiece(std::vector<Mirror>& mirrors, const FlatPiece& piece, const mat4& worldToClip) {
    auto mirror = std::ranges::find_if(mirrors, [&](const Mirror& m) { return samePlane(m, piece); });
    if (mirror == mirrors.end()) {
        mirror = mirrors.insert(mirrors.end(), Mirror{piece.plane, piece.right, piece.up, piece.low, piece.high,
                                                      piece.tolerance, vec2(1.0F), vec2(0.0F), 0.0F});
    } else {
        mirror->low = glm::min(mirror->low, piece.low);
        mirror->high = glm::max(mirror->high, piece.high);
        mirror->tolerance = std::max(mirror->tolerance, piece.tolerance);
    }
    addOnScreen(*mirror, piece, worldToClip);
}

}  // namespace

FlatPiece turnedOver(FlatPiece piece) {
    piece.plane = -piece.plane;
    piece.right = -piece.right;
    const float low = piece.low.x;
    piece.low.x = -piece.high.x;
    piece.high.x = -low;
    return piece;
}

std::vector<FlatPiece> findFlatPieces(const Scene& scene) {
    struct Means {
        float roughness;
        vec3 f0;
    };
    std::map<uint32_t, Means> means;  // by material, so that a texture's mean is computed once
    std::vector<FlatPiece> all;
    const ScenePose pose = scenePose(scene, 0.0);
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        const Material& material = scene.materials.at(mesh.material);
        if (isDeformed(instance) || material.blended) {  // blended ones are not in the G-buffer
            continue;
        }
        if (!means.contains(mesh.material)) {
            means[mesh.material] = {meanRoughness(scene, material), meanReflectance(scene, material)};
        }
        for (FlatPiece& piece : piecesOf(mesh, pose.objectToWorld[i])) {
            piece.instance = i;
            piece.name = instance.name;
            piece.roughness = means[mesh.material].roughness;
            piece.f0 = means[mesh.material].f0;
            piece.doubleSided = material.doubleSided;
            piece.bumpy = material.normalTexture.image >= 0;
            all.push_back(std::move(piece));
        }
    }
    return all;
}

std::vector<FlatPiece> posedFlatPieces(std::span<const FlatPiece> pieces, const Scene& scene, const ScenePose& pose) {
    std::vector<FlatPiece> posed;
    for (size_t i = 0; i < pieces.size();) {
        const size_t first = i;
        const size_t instance = pieces[first].instance;
        while (i < pieces.size() && pieces[i].instance == instance) {
            ++i;
        }
        if (!isAnimated(pose, scene.instances[instance])) {
            posed.insert(posed.end(), pieces.begin() + static_cast<std::ptrdiff_t>(first),
                         pieces.begin() + static_cast<std::ptrdiff_t>(i));
            continue;
        }
        const Mesh& mesh = scene.meshes.at(scene.instances[instance].mesh);
        for (FlatPiece& piece : piecesOf(mesh, pose.objectToWorld[instance])) {
            piece.instance = instance;
            piece.name = pieces[first].name;
            piece.roughness = pieces[first].roughness;
            piece.f0 = pieces[first].f0;
            piece.doubleSided = pieces[first].doubleSided;
            piece.bumpy = pieces[first].bumpy;
            posed.push_back(std::move(piece));
        }
    }
    return posed;
}

std::vector<Mirror> planMirrors(std::span<const FlatPiece> pieces, const ViewParams& view,
                                std::span<const std::string> names, const PlanarSettings& settings) {
    std::vector<Mirror> mirrors;
    for (const FlatPiece& piece : pieces) {
        const bool named = std::ranges::find(names, piece.name) != names.end();
        const bool found = settings.autoDetect != 0 && piece.roughness <= settings.maxRoughness;
        const float side = glm::dot(piece.plane, view.eye);
        if (!(names.empty() ? found : named) || std::abs(side) <= piece.tolerance ||
            (side < 0.0F && !piece.doubleSided)) {
            continue;
        }
        addPiece(mirrors, side < 0.0F ? turnedOver(piece) : piece, view.worldToClip);
    }
    std::erase_if(mirrors, [](const Mirror& m) { return m.area < smallestArea; });
    std::ranges::stable_sort(mirrors, std::greater<>(), &Mirror::area);
    mirrors.resize(std::min<size_t>(mirrors.size(), settings.count));
    return mirrors;
}

vec3 pointOn(const Mirror& mirror, const vec2& at) {
    return vec3(mirror.plane) * -mirror.plane.w + mirror.right * at.x + mirror.up * at.y;
}

}  // namespace reflet
