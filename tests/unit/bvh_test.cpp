// The BVH: the invariants that traversal relies on.
#include "scene/bvh.h"
#include "scene/builtin.h"
#include "scene/builtin/assemble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <tuple>

namespace reflet::bvh_test {
namespace {

SceneTriangle triangleAt(const vec3& place, float size, uint32_t number) {
    return {place, 0, place + vec3(size, 0, 0), number, place + vec3(0, size, 0), 0};
}

bool contains(const vec3& min, const vec3& max, const vec3& point) {
    return glm::all(glm::lessThanEqual(min, point)) && glm::all(glm::lessThanEqual(point, max));
}

// Visits the whole tree: returns its depth, and fails where a box does not contain its subtree.
class Walk {
public:
    explicit Walk(const Bvh& bvh) : bvh_(bvh), seen_(bvh.triangles.size()) { depth_ = visit(0); }

    [[nodiscard]] uint32_t depth() const { return depth_; }
    [[nodiscard]] bool everyTriangleIsInOneLeaf() const {
        return std::ranges::all_of(seen_, [](int times) { return times == 1; });
    }
    [[nodiscard]] uint32_t nodes() const { return nodes_; }

private:
    uint32_t visit(uint32_t index) {
        ++nodes_;
        const BvhNode& n = bvh_.nodes.at(index);
        return 1 + std::max(child(n.left, n.leftMin, n.leftMax), child(n.right, n.rightMin, n.rightMax));
    }
    uint32_t child(uint32_t child, const vec3& min, const vec3& max) {
        if ((child & bvhLeaf) == 0) {
            const BvhNode& n = bvh_.nodes.at(child);
            for (const vec3& corner : {n.leftMin, n.leftMax, n.rightMin, n.rightMax}) {
                EXPECT_TRUE(contains(min, max, corner));
            }
            return visit(child);
        }
        const uint32_t count = ((child & ~bvhLeaf) >> bvhCountShift) + 1;
        for (uint32_t i = 0; i < count; ++i) {
            const SceneTriangle& t = bvh_.triangles.at((child & bvhFirstMask) + i);
            ++seen_[(child & bvhFirstMask) + i];
            EXPECT_TRUE(contains(min, max, t.a) && contains(min, max, t.b) && contains(min, max, t.c));
        }
        return 0;
    }

    const Bvh& bvh_;
    std::vector<int> seen_;
    uint32_t depth_ = 0;
    uint32_t nodes_ = 0;
};

TEST(Bvh, HoldsEveryTriangleOfASceneInOneLeafInsideItsBoxes) {
    const auto triangles = sceneTriangles(findBuiltinScene("cave")->make());
    const Bvh bvh = buildBvh(triangles);
    const Walk walk(bvh);
    EXPECT_TRUE(walk.everyTriangleIsInOneLeaf());
    EXPECT_EQ(walk.nodes(), bvh.nodes.size());
    std::set<std::pair<uint32_t, uint32_t>> names;
    for (const SceneTriangle& t : bvh.triangles) {
        names.emplace(t.instance, t.firstIndex);
    }
    EXPECT_EQ(names.size(), triangles.size());
}

TEST(Bvh, JoinedFromTwoHoldsTheTrianglesOfBothAtThatTime) {
    const Scene scene = findBuiltinScene("moving")->make();
    const ScenePose pose = scenePose(scene, 0.6);
    const auto standing = sceneTriangles(scene, pose, Instances::stationary);
    const auto moving = sceneTriangles(scene, pose, Instances::moving);
    const auto all = sceneTriangles(scene, pose);
    ASSERT_GT(standing.size(), 0U);
    ASSERT_GT(moving.size(), 0U);
    const Bvh bvh = joined(buildBvh(standing, bvhMaxDepth - 1), buildBvh(moving, bvhMaxDepth - 1));
    const Walk walk(bvh);
    EXPECT_TRUE(walk.everyTriangleIsInOneLeaf());
    EXPECT_LE(walk.depth(), bvhMaxDepth);
    const auto key = [](const SceneTriangle& t) { return std::tuple(t.instance, t.firstIndex, t.a.x, t.b.y, t.c.z); };
    std::set<std::tuple<uint32_t, uint32_t, float, float, float>> expected;
    std::set<std::tuple<uint32_t, uint32_t, float, float, float>> found;
    for (const SceneTriangle& t : all) {
        expected.insert(key(t));
    }
    for (const SceneTriangle& t : bvh.triangles) {
        found.insert(key(t));
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(bvh.triangles.size(), all.size());
}

TEST(Bvh, IsTheSameForTheSameTriangles) {
    const auto triangles = sceneTriangles(findBuiltinScene("gloss")->make());
    const Bvh one = buildBvh(triangles);
    const Bvh two = buildBvh(triangles);
    ASSERT_EQ(one.nodes.size(), two.nodes.size());
    EXPECT_EQ(std::memcmp(one.nodes.data(), two.nodes.data(), one.nodes.size() * sizeof(BvhNode)), 0);
    EXPECT_EQ(std::memcmp(one.triangles.data(), two.triangles.data(), one.triangles.size() * sizeof(SceneTriangle)), 0);
}

TEST(Bvh, IsNeverDeeperThanTheStackOfATraversal) {
    std::vector<SceneTriangle> shrinking;  // each split separates one triangle
    for (int i = 0; i < 100; ++i) {
        const float size = std::ldexp(1.0F, -i);
        shrinking.push_back(triangleAt({size, 0, 0}, 0.1F * size, 0));
    }
    const Bvh deep = buildBvh(shrinking);
    const Walk walk(deep);
    EXPECT_TRUE(walk.everyTriangleIsInOneLeaf());
    EXPECT_GT(walk.depth(), 10U);
    EXPECT_LE(walk.depth(), bvhMaxDepth);

    const Bvh same = buildBvh(std::vector<SceneTriangle>(100000, triangleAt({1, 2, 3}, 1, 0)));
    EXPECT_TRUE(Walk(same).everyTriangleIsInOneLeaf());
    EXPECT_LE(Walk(same).depth(), bvhMaxDepth);
}

TEST(Bvh, IsValidForZeroAndForOneTriangle) {
    const Bvh none = buildBvh({});
    EXPECT_EQ(Walk(none).depth(), 1U);
    const Bvh one = buildBvh({triangleAt({1, 1, 1}, 1, 7)});
    EXPECT_EQ(Walk(one).depth(), 1U);
    EXPECT_EQ(one.triangles[one.nodes[0].left & bvhFirstMask].firstIndex, 7U);
}

// A ray would have to try all of them: a file of 4 MB kept the renderer busy for minutes.
TEST(Bvh, HasOfManyEqualTrianglesInOnePlaceTheFirst) {
    std::vector<SceneTriangle> triangles;
    for (uint32_t i = 0; i < 1000; ++i) {
        triangles.push_back(triangleAt(vec3(1, 2, 3), i % 3 == 0 ? 1.0F : 2.0F, i));
    }
    triangles.push_back(triangleAt(vec3(9, 2, 3), 1.0F, 1000));
    const Bvh bvh = buildBvh(triangles);
    EXPECT_TRUE(Walk(bvh).everyTriangleIsInOneLeaf());
    EXPECT_EQ(bvh.triangles.size(), 3U);
    EXPECT_TRUE(std::ranges::any_of(bvh.triangles, [](const SceneTriangle& t) { return t.b == vec3(2, 2, 3); }));
}

TEST(Bvh, LeavesOutTrianglesThatAreNotFinite) {
    Mesh mesh = builtin::box(vec3(1));
    const size_t whole = mesh.indices.size() / 3;
    mesh.indices.insert(mesh.indices.end(), {0, 1, 24, 0, 1, 25});
    builtin::addVertex(mesh, vec3(NAN, 0, 0), vec3(0, 1, 0), vec2(0));
    builtin::addVertex(mesh, vec3(0, INFINITY, 0), vec3(0, 1, 0), vec2(0));
    ASSERT_EQ(mesh.positions.size(), 26U);
    Scene scene;
    builtin::place(scene, "box", builtin::addMaterial(scene, {}), mesh);
    EXPECT_EQ(sceneTriangles(scene).size(), whole);
}

TEST(SceneTriangles, RecordWhereTheyComeFromAndWhichSideIsTheirFront) {
    Scene scene;
    Material leaf;
    leaf.alphaCutoff = 0.5F;
    leaf.doubleSided = true;
    const uint32_t boxes = builtin::addMesh(scene, "box", builtin::addMaterial(scene, {}), builtin::box(vec3(1)));
    const uint32_t leaves = builtin::addMesh(scene, "leaf", builtin::addMaterial(scene, leaf), builtin::patch({}));
    builtin::place(scene, "mirrored", boxes, glm::scale(mat4(1), vec3(-1, 1, 1)));
    builtin::place(scene, "leaf", leaves, builtin::at({5, 0, 0}));
    const auto triangles = sceneTriangles(scene);
    const auto boxIndices = static_cast<uint32_t>(scene.meshes[boxes].indices.size());
    EXPECT_EQ(triangles.front().instance, 0U);
    EXPECT_EQ(triangles.front().firstIndex, 0U);
    EXPECT_EQ(triangles.front().flags, triangleMirrored);
    EXPECT_EQ(triangles.back().instance, 1U);
    EXPECT_EQ(triangles.back().firstIndex, boxIndices + 3);
    EXPECT_EQ(triangles.back().flags, triangleCutOut | triangleDoubleSided);
    EXPECT_GE(triangles.back().a.x, 4.0F);
}

}  // namespace
}  // namespace reflet::bvh_test
