// Rows of houses of the built-in scene "street": brick and plaster fronts with holes for windows, a shop below each.
#include "scene/builtin/assemble.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/street.h"

#include <array>
#include <cmath>
#include <string>

namespace reflet::builtin::street {
namespace {

constexpr float brickTile = 1.6F;  // metres that the image of bricks shows
constexpr float shopHeight = 3.7F;
constexpr float storey = 3.1F;

struct Brick {
    int course = 0;
    int number = 0;
    float toEdge = 0.0F;  // metres
};

Brick brickAt(const vec2& uv) {
    constexpr int courses = 20;  // 8 cm
    constexpr int bricks = 6;
    Brick b;
    b.course = std::min(static_cast<int>(uv.y * courses), courses - 1);
    const float x = uv.x * bricks + (b.course % 2 == 0 ? 0.0F : 0.5F);
    b.number = static_cast<int>(x) % bricks;
    const float across = std::min(x - std::floor(x), std::ceil(x) - x) * brickTile / bricks;
    const float y = uv.y * courses - static_cast<float>(b.course);
    b.toEdge = std::min(across, std::min(y, 1.0F - y) * brickTile / courses);
    return b;
}

TextureImage brickColors(const std::string& name, Hex brick, Hex other, Hex mortar) {
    Canvas canvas(name, 256, 256, mortar);
    canvas.paint([&](const vec2& uv) {
        const Brick b = brickAt(uv);
        const float soot = 0.5F + 0.5F * tilingNoise(uv, 4, 4, 41U);
        const Hex stone = mixed(brick, other, hash01(b.course, b.number, 0, 42U));
        return mixed(b.toEdge < 0.006F ? mortar : stone, 0x1E1A19, 0.45F * soot);
    });
    canvas.grain(8.0F, 43U);
    return canvas.finish();
}

TextureImage plasterColors(Hex plaster) {
    Canvas canvas("plaster", 256, 256, plaster);
    canvas.paint([&](const vec2& uv) {
        const float stain = 0.5F + 0.5F * tilingNoise({uv.x, 0.25F * uv.y}, 8, 4, 44U);
        return mixed(plaster, 0x2B2724, 0.5F * stain * stain + 0.1F * tilingNoise(uv, 16, 3, 45U));
    });
    canvas.grain(5.0F, 46U);
    return canvas.finish();
}

struct Walls {
    std::array<uint32_t, 5> fronts{};  // materials
    uint32_t stone = 0;                // cornices
    uint32_t roof = 0;
};

Walls addWalls(Scene& scene) {
    const TextureSlot brickRelief = addTexture(scene, normalMap("brick relief", 256, brickTile, [](const vec2& uv) {
                                                   return 0.006F * glm::smoothstep(0.002F, 0.01F, brickAt(uv).toEdge) +
                                                          0.0025F * tilingNoise(uv, 24, 2, 47U);
                                               }));
    const auto scaled = [](TextureSlot slot, float metres) {
        slot.uvTransform = {vec3(1.0F / metres, 0, 0), vec3(0, 1.0F / metres, 0)};
        return slot;
    };
    Walls walls;
    const std::array<std::array<Hex, 3>, 3> bricks{
        {{0x8A4632, 0x6B3226, 0x6E675E}, {0x9A7A58, 0x7E6248, 0x5F5850}, {0x5A4A46, 0x43383A, 0x77726A}}};
    for (size_t i = 0; i < bricks.size(); ++i) {
        const std::string name = "brick " + std::to_string(i);
        Material m = textured(
            name, scaled(addTexture(scene, brickColors(name, bricks[i][0], bricks[i][1], bricks[i][2])), brickTile),
            0.6F);
        m.normalTexture = scaled(brickRelief, brickTile);
        walls.fronts[i] = addMaterial(scene, m);
    }
    const TextureSlot plaster = scaled(addTexture(scene, plasterColors(0xE8DFD0)), 4.0F);
    Material cream = textured("cream plaster", plaster, 0.75F);
    cream.baseColor = vec4(0.75F, 0.62F, 0.46F, 1);
    walls.fronts[3] = addMaterial(scene, cream);
    Material teal = textured("teal plaster", plaster, 0.75F);
    teal.baseColor = vec4(0.2F, 0.42F, 0.44F, 1);
    walls.fronts[4] = addMaterial(scene, teal);
    walls.stone = addMaterial(scene, plain("cornice", {0x9B9184, 0.7F}));
    walls.roof = addMaterial(scene, plain("roof", {0x1B1B1D, 0.8F}));
    return walls;
}

struct House {
    float width = 8.0F;
    int storeys = 3;  ///< above the shop
    size_t wall = 0;  ///< index into Walls::fronts
    uint32_t seed = 0;
};

// A cell of the wall around a window, from its lower left corner.
void addCell(Mesh& mesh, const vec3& corner, const vec2& size) {
    const vec2 hole = Openings::window;
    const float x = 0.5F * (size.x - hole.x);
    constexpr float y = 0.85F;
    const vec3 right(1, 0, 0);
    const vec3 up(0, 1, 0);
    const vec3 in(0, 0, -Openings::depth);
    addQuad(mesh, corner, x * right, size.y * up);
    addQuad(mesh, corner + (x + hole.x) * right, x * right, size.y * up);
    addQuad(mesh, corner + x * right, hole.x * right, y * up);
    addQuad(mesh, corner + x * right + (y + hole.y) * up, hole.x * right, (size.y - y - hole.y) * up);
    const vec3 low = corner + x * right + y * up;
    addQuad(mesh, low, in, hole.y * up);
    addQuad(mesh, low + hole.x * right + in, -in, hole.y * up);
    addQuad(mesh, low, hole.x * right, in);
    addQuad(mesh, low + hole.y * up + in, hole.x * right, -in);
}

// Cornices, sides and roof.
void addTrim(Scene& scene, const Walls& walls, const House& h, const mat4& toWorld) {
    const float top = shopHeight + storey * static_cast<float>(h.storeys);
    const std::string name = "house " + std::to_string(h.seed);
    const float half = 0.5F * h.width;
    Mesh trim;
    append(trim, box({half, 0.14F, 0.16F}), at({half, shopHeight + 0.02F, 0.1F}));
    append(trim, box({half, 0.1F, 0.3F}), at({half, top + 0.35F, 0.2F}));
    append(trim, box({half, 0.22F, 0.16F}), at({half, top + 0.05F, 0.08F}));
    for (int i = 0; static_cast<float>(i) * 0.45F < h.width - 0.3F; ++i) {
        append(trim, box({0.07F, 0.12F, 0.13F}), at({0.3F + 0.45F * static_cast<float>(i), top + 0.16F, 0.3F}));
    }
    place(scene, name + " trim", walls.stone, trim, toWorld);
    place(scene, name + " body", walls.roof, box({half - 0.01F, 0.5F * top, 4.0F}),
          toWorld * at({half, 0.5F * top, -4.35F}));
}

void addHouse(Scene& scene, const Walls& walls, Openings& openings, const House& h, const mat4& toWorld) {
    const int columns = static_cast<int>(h.width / 1.95F);
    const vec2 cell(h.width / static_cast<float>(columns), storey);
    Mesh wall;
    for (int row = 0; row < h.storeys; ++row) {
        for (int column = 0; column < columns; ++column) {
            const vec3 corner(cell.x * static_cast<float>(column), shopHeight + storey * static_cast<float>(row), 0);
            addCell(wall, corner, cell);
            const uint32_t pick = hash(column, row, 0, h.seed);
            openings.addWindow(toWorld * at(corner + vec3(0.5F * cell.x, 0.85F, 0)), pick);
        }
    }
    const vec3 top(0, shopHeight + storey * static_cast<float>(h.storeys), 0);
    addQuad(wall, top, {h.width, 0, 0}, {0, 0.5F, 0});
    for (const float x : {0.0F, h.width}) {  // the edges of the front
        addQuad(wall, {x, shopHeight, x == 0.0F ? -0.4F : 0.0F}, {0, 0, x == 0.0F ? 0.4F : -0.4F},
                {0, top.y - shopHeight, 0});
    }
    finish(wall);
    place(scene, "house " + std::to_string(h.seed), walls.fronts.at(h.wall), wall, toWorld);
    addTrim(scene, walls, h, toWorld);
    openings.addShop(toWorld * at({0.5F * h.width, 0, 0}), {h.width, shopHeight}, h.seed);
}

// Beyond the street: towers of offices before the glow of the sky.
void addTowers(Scene& scene) {
    Canvas lights("offices", 64, 128, 0x000000);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 16; ++x) {
            if (hash01(x, y, 0, 48U) < 0.13F) {
                lights.rectangle({4 * x + 1, 4 * y + 1, 2, 2}, hash01(x, y, 1, 48U) < 0.6F ? 0xFFC98A : 0xB8D8FF);
            }
        }
    }
    Material m = plain("tower", {0x232430, 0.6F});
    m.emissive = vec3(0.8F);
    m.emissiveTexture = addTexture(scene, lights.finish());
    const uint32_t tower = addMesh(scene, "tower", addMaterial(scene, m), box({1, 1, 1}));
    struct Place {
        float x, z, width, height;
    };
    static constexpr std::array<Place, 7> places{{{-17, -76, 6, 14},
                                                  {-7.5F, -92, 5, 21},
                                                  {3, -88, 4, 12},
                                                  {10, -80, 5, 17},
                                                  {21, -90, 7, 25},
                                                  {-28, -90, 7, 19},
                                                  {-1.5F, -105, 3, 27}}};
    for (size_t i = 0; i < places.size(); ++i) {
        const Place& p = places[i];
        place(scene, "tower " + std::to_string(i), tower,
              glm::scale(at({p.x, 0.5F * p.height, p.z}), vec3(0.5F * p.width, 0.5F * p.height, 0.5F * p.width)));
    }
}

}  // namespace

void addHouses(Scene& scene) {
    const Walls walls = addWalls(scene);
    Openings openings(scene);
    static constexpr std::array<House, 7> left{{{9.6F, 3, 1, 1},
                                                {8.2F, 4, 0, 2},
                                                {9.8F, 3, 3, 3},
                                                {7.9F, 4, 2, 4},
                                                {8.6F, 3, 4, 5},
                                                {8.0F, 5, 0, 6},
                                                {8.0F, 3, 1, 7}}};
    static constexpr std::array<House, 7> right{{{9.0F, 4, 2, 11},
                                                 {9.4F, 3, 4, 12},
                                                 {7.9F, 4, 0, 13},
                                                 {9.8F, 3, 1, 14},
                                                 {8.2F, 5, 3, 15},
                                                 {7.9F, 3, 2, 16},
                                                 {7.9F, 4, 0, 17}}};
    float z = nearEnd;
    for (const House& h : left) {
        addHouse(scene, walls, openings, h, side(true, z));
        z -= h.width;
    }
    z = nearEnd;
    for (const House& h : right) {
        z -= h.width;
        addHouse(scene, walls, openings, h, side(false, z));
    }
    addTowers(scene);
}

}  // namespace reflet::builtin::street
