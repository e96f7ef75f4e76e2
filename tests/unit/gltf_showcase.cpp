// Scenes for tests that together have every property that the loader reads.
#include "gltf_showcase.h"

#include "gltf_encoders.h"

namespace reflet::test {

using nlohmann::json;

namespace {

json extensionsOf(const char* name, const json& extension) {
    return {{"extensions", {{name, extension}}}};
}

/// Attributes and indices of a unit square in the xy-plane that faces +z.
json square(GltfBuilder& b) {
    const std::vector<float> interleaved{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1};
    const int view = b.addView(interleaved.data(), interleaved.size() * sizeof(float), 24);
    const json corner{{"bufferView", view}, {"componentType", floatType}, {"count", 4}, {"type", "VEC3"}};
    json normals = corner;
    normals["byteOffset"] = 12;
    const int positions = b.add("accessors", corner);
    const int normal = b.add("accessors", normals);
    const int uvs = b.addAccessor<uint8_t>({0, 255, 255, 255, 255, 0, 0, 0}, "VEC2", ubyteType);
    b.document["accessors"][static_cast<size_t>(uvs)]["normalized"] = true;
    const int others = b.addFloats({0, 0, 0, 3, 3, 3, 3, 0}, "VEC2");
    const int tangents = b.addFloats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    const int colors = b.addFloats({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0.5, 0.7, 0.9, 1}, "VEC4");
    return {{"attributes",
             {{"POSITION", positions},
              {"NORMAL", normal},
              {"TEXCOORD_0", uvs},
              {"TEXCOORD_1", others},
              {"TANGENT", tangents},
              {"COLOR_0", colors}}},
            {"indices", b.addAccessor<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR", ushortType)}};
}

/// Texels that differ in every channel.
int addPattern(GltfBuilder& b) {
    std::vector<uint16_t> texels;
    for (size_t i = 0; i < size_t{4} * 4 * 4; ++i) {
        texels.push_back(static_cast<uint16_t>(16384 + 49151 * ((i * 37) % 64) / 64));
    }
    const int texture = addTextureOf(b, deepPngOf(4, 4, texels), "");
    b.document["images"][0]["mimeType"] = "image/png";
    b.document["textures"][0]["sampler"] =
        b.add("samplers", {{"magFilter", 9728}, {"minFilter", 9984}, {"wrapS", 33071}, {"wrapT", 33648}});
    return texture;
}

/// Normals that lean towards +x and +y, in a file of their own.
int addBumps(GltfBuilder& b) {
    const int image = b.add(
        "images", {{"name", "bumps"}, {"uri", "data:image/png;base64," + base64(pngOf(1, 1, {170, 150, 230, 255}))}});
    return b.add("textures", {{"source", image}});
}

std::vector<json> layeredMaterials(const json& texture, const json& bumps) {
    const json grey{{"baseColorFactor", {0.6, 0.5, 0.4, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.3}};
    const auto with = [&](const char* name, const json& extension) {
        json material{{"pbrMetallicRoughness", grey}};
        material.update(extensionsOf(name, extension));
        return material;
    };
    json moved = texture;
    moved["texCoord"] = 0;
    moved.update(extensionsOf("KHR_texture_transform",
                              {{"offset", {0.2, 0.1}}, {"rotation", 0.4}, {"scale", {1.5, 0.7}}, {"texCoord", 1}}));
    json scaled = bumps;
    scaled["scale"] = 0.6;
    json second = texture;
    second["texCoord"] = 1;
    json weak = texture;
    weak["strength"] = 0.5;
    json base{{"name", "base"},
              {"pbrMetallicRoughness",
               {{"baseColorFactor", {0.9, 0.8, 0.7, 1}},
                {"baseColorTexture", moved},
                {"metallicFactor", 0.6},
                {"roughnessFactor", 0.5},
                {"metallicRoughnessTexture", second}}},
              {"normalTexture", scaled},
              {"occlusionTexture", weak},
              {"emissiveTexture", texture},
              {"emissiveFactor", {0.3, 0.2, 0.1}}};
    base.update(extensionsOf("KHR_materials_emissive_strength", {{"emissiveStrength", 2}}));
    json glass = with("KHR_materials_transmission", {{"transmissionFactor", 0.9}, {"transmissionTexture", texture}});
    glass["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 0.8},
                                                   {"thicknessTexture", texture},
                                                   {"attenuationDistance", 0.5},
                                                   {"attenuationColor", {0.9, 0.3, 0.2}}};
    glass["extensions"]["KHR_materials_dispersion"] = {{"dispersion", 3}};
    glass["extensions"]["KHR_materials_ior"] = {{"ior", 1.8}};
    json brushed = with("KHR_materials_anisotropy",
                        {{"anisotropyStrength", 0.9}, {"anisotropyRotation", 0.7}, {"anisotropyTexture", texture}});
    brushed["pbrMetallicRoughness"]["metallicFactor"] = 1;
    json masked{{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}, {"alphaMode", "MASK"}, {"alphaCutoff", 0.7}};
    json blended{{"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.9, 0.3, 0.5}}}}, {"alphaMode", "BLEND"}};
    json unlit = with("KHR_materials_unlit", json::object());
    json turned{{"pbrMetallicRoughness", grey}, {"doubleSided", true}};
    return {base,
            glass,
            brushed,
            masked,
            blended,
            unlit,
            with("KHR_materials_clearcoat", {{"clearcoatFactor", 0.9},
                                             {"clearcoatTexture", texture},
                                             {"clearcoatRoughnessFactor", 0.5},
                                             {"clearcoatRoughnessTexture", texture},
                                             {"clearcoatNormalTexture", bumps}}),
            with("KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.8},
                                                        {"diffuseTransmissionTexture", texture},
                                                        {"diffuseTransmissionColorFactor", {0.9, 0.4, 0.2}},
                                                        {"diffuseTransmissionColorTexture", texture}}),
            with("KHR_materials_iridescence", {{"iridescenceFactor", 0.9},
                                               {"iridescenceTexture", texture},
                                               {"iridescenceIor", 1.7},
                                               {"iridescenceThicknessMinimum", 200},
                                               {"iridescenceThicknessMaximum", 600},
                                               {"iridescenceThicknessTexture", texture}}),
            with("KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.7, 0.2, 0.3, 1}},
                                                         {"diffuseTexture", texture},
                                                         {"specularFactor", {0.3, 0.4, 0.5}},
                                                         {"glossinessFactor", 0.6},
                                                         {"specularGlossinessTexture", texture}}),
            with("KHR_materials_sheen", {{"sheenColorFactor", {0.9, 0.6, 0.3}},
                                         {"sheenColorTexture", texture},
                                         {"sheenRoughnessFactor", 0.6},
                                         {"sheenRoughnessTexture", texture}}),
            with("KHR_materials_specular", {{"specularFactor", 0.7},
                                            {"specularTexture", texture},
                                            {"specularColorFactor", {1, 0.5, 0.2}},
                                            {"specularColorTexture", texture}}),
            turned};
}

}  // namespace

GltfBuilder layered() {
    GltfBuilder b;
    const json shape = square(b);
    const json texture{{"index", addPattern(b)}};
    const json bumps{{"index", addBumps(b)}};
    constexpr size_t columns = 4;
    const std::vector<json> materials = layeredMaterials(texture, bumps);
    for (size_t i = 0; i < materials.size(); ++i) {
        json primitive = shape;
        primitive["material"] = b.add("materials", materials[i]);
        const int mesh = b.add("meshes", {{"primitives", {primitive}}});
        const bool last = i + 1 == materials.size();  // from behind
        json node{{"mesh", mesh},
                  {"translation", {1.1 * double(i % columns) + (last ? 1 : 0), 1.1 * double(i / columns), 0}}};
        if (last) {
            node["rotation"] = {0, 1, 0, 0};
        }
        b.addRoot(node);
        const json extensions = materials[i].value("extensions", json::object());
        for (const auto& [name, extension] : extensions.items()) {
            b.document["extensionsUsed"].push_back(name);
        }
    }
    b.document["extensionsUsed"].push_back("KHR_texture_transform");
    // Behind what is transparent.
    json backdrop = shape;
    backdrop["material"] = b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}});
    b.addRoot({{"mesh", b.add("meshes", {{"primitives", {backdrop}}})},
               {"translation", {-1, -1, -0.5}},
               {"scale", {7, 7, 1}}});
    return b;
}

namespace {

void addCameras(GltfBuilder& b) {
    b.add("cameras",
          {{"name", "lens"},
           {"type", "perspective"},
           {"perspective", {{"aspectRatio", 1.5}, {"yfov", 0.9}, {"znear", 0.1}, {"zfar", 100}}},
           {"extras", {{"aperture_radius", 0.1}, {"focus_distance", 2}, {"blades", 5}, {"blade_rotation", 20}}}});
    b.add("cameras", {{"name", "film"},
                      {"type", "perspective"},
                      {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}},
                      {"extras", {{"f_number", 1.4}, {"sensor_height", 200}, {"focus", "moving"}}}});
    b.add("cameras", {{"name", "flat"},
                      {"type", "orthographic"},
                      {"orthographic", {{"xmag", 2}, {"ymag", 2}, {"znear", 0}, {"zfar", 50}}}});
    for (int camera = 0; camera < 3; ++camera) {
        b.addRoot({{"camera", camera}, {"translation", {0.2 * camera, 0, 4}}});
    }
}

void addLamps(GltfBuilder& b) {
    b.document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"name", "bulb"},
         {"type", "point"},
         {"color", {1, 0.8, 0.5}},
         {"intensity", 9},
         {"range", 3},
         {"extras", {{"radius", 0.3}}}},
        {{"type", "spot"}, {"intensity", 20}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}}},
        {{"type", "directional"}, {"intensity", 0.5}}};
    for (int light = 0; light < 3; ++light) {
        b.addRoot({{"translation", {light - 1, 1, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    }
}

/// Between a lamp and the squares: a strip of quantized positions.
void addBlocker(GltfBuilder& b) {
    const std::vector<int16_t> corners{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0};
    const int view = b.addView(corners.data(), corners.size() * sizeof(int16_t), 8);
    const int positions =
        b.add("accessors", {{"bufferView", view}, {"componentType", shortType}, {"count", 4}, {"type", "VEC3"}});
    const json strip{{"attributes", {{"POSITION", positions}}}, {"mode", 5}};
    b.addRoot({{"mesh", b.add("meshes", {{"primitives", {strip}}})},
               {"matrix", {0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, -0.9, 0.3, 1, 1}}});
}

/// A morph target that moves the third vertex: the only value of a sparse accessor, behind another one.
int addSparseTarget(GltfBuilder& b) {
    const std::array<uint16_t, 2> indices{9, 2};
    const std::array<float, 6> values{9, 9, 9, 0.5, 0.5, 0};
    return b.add("accessors",
                 {{"componentType", floatType},
                  {"count", 4},
                  {"type", "VEC3"},
                  {"sparse",
                   {{"count", 1},
                    {"indices",
                     {{"bufferView", b.addView(indices.data(), sizeof indices)},
                      {"byteOffset", 2},
                      {"componentType", ushortType}}},
                    {"values", {{"bufferView", b.addView(values.data(), sizeof values)}, {"byteOffset", 12}}}}}});
}

/// Of the node: steps along x, a spline along y, and the base colour of material 0 by a pointer.
void addAnimations(GltfBuilder& b, int node) {
    const int times = b.addFloats({0, 0.5, 2}, "SCALAR");
    const int steps = b.addFloats({-1, -1, 0, -0.5, -1, 0, 2, -1, 0}, "VEC3");
    const int spline = b.addFloats({0, 0, 0, 1,    1, 1, 1, 0, 0,  //
                                    0, 0, 0, 1.2F, 1, 1, 0, 1, 0,  //
                                    0, 0, 0, 1,    1, 1, 0, 0, 0},
                                   "VEC3");
    const int colors = b.addFloats({1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1}, "VEC4");
    b.add(
        "animations",
        {{"name", "all"},
         {"samplers",
          {{{"input", times}, {"output", steps}, {"interpolation", "STEP"}},
           {{"input", times}, {"output", spline}, {"interpolation", "CUBICSPLINE"}},
           {{"input", times}, {"output", colors}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}},
           {{"sampler", 1}, {"target", {{"node", node}, {"path", "scale"}}}},
           {{"sampler", 2},
            {"target",
             {{"path", "pointer"},
              {"extensions",
               {{"KHR_animation_pointer", {{"pointer", "/materials/0/pbrMetallicRoughness/baseColorFactor"}}}}}}}}}}});
}

}  // namespace

GltfBuilder staged() {
    GltfBuilder b;
    json shape = square(b);
    shape["targets"] = {{{"POSITION", addSparseTarget(b)}}};
    shape["material"] = b.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.2, 0.2, 1}}}}});
    const int night = b.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.1, 0.6, 1}}}}});
    shape["extensions"]["KHR_materials_variants"]["mappings"] = {{{"variants", {1}}, {"material", night}}};
    b.document["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "day"}}, {{"name", "night"}}};
    const int mesh = b.add("meshes", {{"name", "square"}, {"primitives", {shape}}, {"weights", {0.9}}});
    b.addRoot({{"mesh", mesh}, {"translation", {-1, 0, 0}}});
    b.addRoot({{"mesh", mesh}, {"translation", {0.2, 0, 0}}, {"weights", {0.2}}});
    b.addRoot({{"mesh", mesh},
               {"translation", {-2, -2, 1}},
               {"scale", {2, 4, 1}},
               {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
    b.addRoot({{"name", "moving"}, {"mesh", mesh}, {"translation", {-1, -1, 0}}});
    json screen = shape;
    screen["material"] = b.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.9, 0.2, 1}}}},
                                             {"extras", {{"camera", "flat"}}}});
    b.addRoot({{"mesh", b.add("meshes", {{"primitives", {screen}}, {"weights", {0.5}}})}, {"translation", {1, 1, 0}}});
    addBlocker(b);
    addAnimations(b, 3);
    addCameras(b);
    addLamps(b);
    b.document["asset"]["minVersion"] = "2.0";
    b.document["scenes"][0]["name"] = "stage";
    const json rehearsal{{"name", "rehearsal"},
                         {"nodes", {b.add("nodes", {{"mesh", mesh}, {"translation", {3, 0, 0}}})}}};
    b.document["scenes"].insert(b.document["scenes"].begin(), rehearsal);
    b.document["scene"] = 1;
    b.document["extensionsUsed"] = {"KHR_animation_pointer", "KHR_lights_punctual", "KHR_materials_variants",
                                    "KHR_mesh_quantization", "KHR_node_visibility"};
    return b;
}

std::vector<std::pair<std::string, GltfBuilder>> showcase() {
    GltfBuilder newer = compressed(true);
    std::string text = newer.document.dump();
    for (size_t at = 0; (at = text.find("EXT_meshopt", at)) != std::string::npos;) {
        text.replace(at, 3, "KHR");
    }
    newer.document = json::parse(text);
    GltfBuilder skinned = bent();
    skinned.document["skins"][0]["name"] = "skin";
    return {{"everything", everything()}, {"slider", slider()},    {"bent", skinned},      {"morphing", morphing()},
            {"compressed", compressed()}, {"recompressed", newer}, {"layered", layered()}, {"staged", staged()}};
}

}  // namespace reflet::test
