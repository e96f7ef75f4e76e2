// Lists of passes become plans that are right by a checker that looks at every pair of uses.
#include "gpu/plan.h"
#include "unit/plan_checker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace reflet::test::plan_test {
namespace {

using gpu::Access;
using gpu::compile;
using gpu::GraphResource;
using gpu::PassGraph;
using gpu::Plan;

constexpr Access reading{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT, false};
constexpr Access writing{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                         VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT, true};
constexpr Access indirect{VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, false};
constexpr Access clearing{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true};
constexpr Access copying{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, false};
constexpr Access drawing{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                         VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, true};

class Graph {
public:
    Graph() { graph.heaps.resize(1); }

    uint32_t transient(VkDeviceSize size = 100, bool image = true) {
        GraphResource resource;
        resource.transient = true;
        resource.image = image;
        resource.size = size;
        resource.alignment = 4;
        return add(resource);
    }
    uint32_t output(VkDeviceSize size = 100) {
        const uint32_t index = transient(size);
        graph.resources[index].output = true;
        return index;
    }
    uint32_t kept() {
        GraphResource resource;
        resource.image = true;
        return add(resource);
    }
    uint32_t pass(const std::vector<gpu::ResourceUse>& uses, bool root = false) {
        graph.passes.push_back({static_cast<uint32_t>(graph.uses.size()), static_cast<uint32_t>(uses.size()), root});
        graph.uses.insert(graph.uses.end(), uses.begin(), uses.end());
        return static_cast<uint32_t>(graph.passes.size() - 1);
    }
    Plan plan() const {
        const Plan made = compile(graph);
        EXPECT_EQ(faultOf(graph, made), "");
        return made;
    }

    PassGraph graph;

private:
    uint32_t add(const GraphResource& resource) {
        graph.resources.push_back(resource);
        return static_cast<uint32_t>(graph.resources.size() - 1);
    }
};

TEST(Plan, ADiamondHasOneBarrierForEachLevel) {
    Graph g;
    const uint32_t top = g.transient();
    const uint32_t left = g.transient();
    const uint32_t right = g.transient();
    const uint32_t bottom = g.output();
    g.pass({{top, writing}});
    g.pass({{top, reading}, {left, writing}});
    g.pass({{top, reading}, {right, writing}});
    g.pass({{left, reading}, {right, reading}, {bottom, writing}});
    const Plan plan = g.plan();
    ASSERT_EQ(plan.barriers.size(), 3U) << "the first brings images into their layout";
    EXPECT_EQ(plan.barriers[1].before, 1U);
    EXPECT_EQ(plan.barriers[2].before, 3U);
}

TEST(Plan, IndependentChainsShareTheirBarriers) {
    Graph g;
    const uint32_t sum = g.output();
    std::vector<gpu::ResourceUse> all{{sum, writing}};
    for (int chain = 0; chain < 3; ++chain) {
        uint32_t last = g.transient();
        g.pass({{last, writing}});
        for (int i = 0; i < 4; ++i) {
            const uint32_t next = g.transient();
            g.pass({{last, reading}, {next, writing}});
            last = next;
        }
        all.push_back({last, reading});
    }
    g.pass(all);
    const Plan plan = g.plan();
    EXPECT_EQ(plan.order.size(), 16U);
    EXPECT_EQ(plan.barriers.size(), 6U);
}

TEST(Plan, AListCanKeepItsOrder) {
    Graph g;
    const uint32_t out = g.output();
    const uint32_t first = g.transient();
    const uint32_t second = g.transient();
    const uint32_t other = g.transient();
    g.pass({{first, writing}});
    g.pass({{first, reading}, {second, writing}});
    g.pass({{other, writing}});
    g.pass({{second, reading}, {other, reading}, {out, writing}});
    EXPECT_EQ(g.plan().order, (std::vector<uint32_t>{0, 2, 1, 3}));
    g.graph.order = gpu::PassOrder::asListed;
    EXPECT_EQ(g.plan().order, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(g.plan().levels, (std::vector<uint32_t>{0, 1, 2, 3}));
}

TEST(Plan, TwoThatOnlyReadHaveNoBarrierBetweenThem) {
    Graph g;
    const uint32_t source = g.kept();
    g.graph.resources[source].before = {writing.stages, VK_ACCESS_2_SHADER_WRITE_BIT, 0, reading.stages,
                                        reading.access};
    g.pass({{source, reading}}, true);
    g.pass({{source, reading}}, true);
    EXPECT_TRUE(g.plan().barriers.empty());
}

TEST(Plan, AWriteAfterAReadWaits) {
    Graph g;
    const uint32_t image = g.kept();
    const uint32_t out = g.output();
    g.pass({{image, reading}, {out, writing}});
    g.pass({{image, clearing}});
    const Plan plan = g.plan();
    EXPECT_EQ(plan.order, (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(plan.barriers.back().before, 1U);
    EXPECT_EQ(plan.after[image].writeStages, clearing.stages);
}

TEST(Plan, PingPongKeepsItsOrder) {
    Graph g;
    const uint32_t a = g.kept();
    const uint32_t b = g.kept();
    for (int i = 0; i < 4; ++i) {
        g.pass({{i % 2 == 0 ? a : b, reading}, {i % 2 == 0 ? b : a, writing}});
    }
    const Plan plan = g.plan();
    EXPECT_EQ(plan.order, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(plan.barriers.size(), 3U);
}

TEST(Plan, WhatNobodyReadsIsDropped) {
    Graph g;
    const uint32_t unread = g.transient();
    const uint32_t before = g.transient();
    const uint32_t out = g.output();
    g.pass({{before, writing}});
    g.pass({{before, reading}, {unread, writing}});
    g.pass({{out, writing}});
    const Plan plan = g.plan();
    EXPECT_EQ(plan.order, (std::vector<uint32_t>{2}));
    EXPECT_EQ(plan.offsets[unread], Plan::unplaced);
    EXPECT_EQ(plan.offsets[before], Plan::unplaced);
}

TEST(Plan, AReadBackIsNeededAndWithItWhatItReads) {
    Graph g;
    const uint32_t image = g.transient();
    g.pass({{image, writing}});
    g.pass({{image, copying}}, true);
    EXPECT_EQ(g.plan().order.size(), 2U);
}

TEST(Plan, WhatIsWrittenInPartsKeepsAllItsWriters) {
    Graph g;
    const uint32_t image = g.output();
    g.pass({{image, clearing}});
    g.pass({{image, writing}});
    g.pass({{image, drawing}});
    EXPECT_EQ(g.plan().order, (std::vector<uint32_t>{0, 1, 2}));
}

TEST(Plan, IndirectArgumentsAreWaitedForAtTheirStage) {
    Graph g;
    const uint32_t list = g.transient(16, false);
    const uint32_t out = g.output();
    g.pass({{list, clearing}});
    g.pass({{list, writing}});
    g.pass({{list, merged(indirect, reading)}, {out, writing}});
    const Plan plan = g.plan();
    EXPECT_NE(plan.barriers.back().to.stages & VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, 0U);
    EXPECT_NE(plan.barriers.back().to.access & VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0U);
}

TEST(Plan, ReadsOfTwoKindsAreBothMadeVisible) {
    Graph g;
    const uint32_t image = g.transient();
    const uint32_t out = g.output();
    g.pass({{image, writing}});
    g.pass({{image, copying}}, true);
    g.pass({{image, reading}, {out, writing}});
    const Plan plan = g.plan();
    const gpu::PlannedBarrier& barrier = plan.barriers.back();
    EXPECT_EQ(barrier.before, 1U);
    EXPECT_EQ(barrier.to.stages, copying.stages | reading.stages);
}

TEST(Plan, AChainLivesInTheMemoryOfTwo) {
    Graph g;
    uint32_t last = g.transient(1000);
    g.pass({{last, writing}});
    for (int i = 0; i < 10; ++i) {
        const uint32_t next = g.transient(1000);
        g.pass({{last, reading}, {next, writing}});
        last = next;
    }
    g.graph.resources[last].output = true;
    const Plan plan = g.plan();
    EXPECT_EQ(plan.ends[0], 2000U);
}

TEST(Plan, NothingLiesAcrossBlocksOrInWhatIsTaken) {
    Graph g;
    g.graph.heaps[0].blocks = {100, 250};
    g.graph.heaps[0].taken = {{120, 40}};
    g.graph.heaps[0].before = {writing.stages, VK_ACCESS_2_SHADER_WRITE_BIT, true};
    const uint32_t small = g.output(100);
    const uint32_t wide = g.output(180);
    const uint32_t large = g.output(300);
    g.pass({{small, writing}, {wide, writing}, {large, writing}});
    const Plan plan = g.plan();
    EXPECT_EQ(plan.offsets[small], 0U);
    EXPECT_EQ(plan.offsets[wide], 160U);
    EXPECT_EQ(plan.offsets[large], 352U) << "350, the end of the blocks, aligned";
}

// Lists that nobody would write.
class RandomGraph {
public:
    explicit RandomGraph(uint32_t seed) : random_(seed) {
        graph.heaps.resize(1 + upTo(2));
        for (gpu::GraphHeap& heap : graph.heaps) {
            fill(heap);
        }
        graph.resources.resize(1 + upTo(16));
        for (GraphResource& resource : graph.resources) {
            fill(resource);
        }
        holdSome();
        for (uint32_t passes = upTo(30); passes > 0; --passes) {
            addPass();
        }
    }

    PassGraph graph;

private:
    uint32_t upTo(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
    Access kind(uint32_t most) {
        const Access kinds[] = {reading, writing, indirect, clearing, copying, drawing, merged(indirect, reading)};
        return kinds[upTo(most)];
    }

    void fill(gpu::GraphHeap& heap) {
        for (uint32_t i = upTo(3); i > 0; --i) {
            heap.blocks.push_back(64 + upTo(1000));
        }
        if (upTo(2) == 0) {
            heap.taken.push_back({4 * upTo(100), 4 + upTo(200)});
        }
        heap.before = upTo(2) == 0 ? Access{} : Access{writing.stages, VK_ACCESS_2_SHADER_WRITE_BIT, true};
    }

    void fill(GraphResource& r) {
        r.transient = upTo(3) > 0;
        r.image = upTo(4) > 0;
        r.output = r.transient && upTo(6) == 0;
        r.undefined = !r.transient && r.image && upTo(4) == 0;
        r.heap = upTo(static_cast<uint32_t>(graph.heaps.size()));
        r.size = 1 + upTo(300);
        r.alignment = 1U << upTo(5);
        if (!r.transient && !r.undefined && upTo(2) == 0) {
            const Access before = kind(6);
            r.before = {before.stages, before.write ? before.access : 0, upTo(2) == 0 ? reading.stages : 0, 0, 0};
            if (upTo(2) == 0) {
                r.before.visibleStages = reading.stages;
                r.before.visibleAccess = reading.access;
            }
        }
    }

    // Some of what is kept lies in a heap, one behind another, behind what may be taken.
    void holdSome() {
        std::vector<VkDeviceSize> ends(graph.heaps.size(), 700);
        for (uint32_t i = 0; i < graph.resources.size(); ++i) {
            GraphResource& r = graph.resources[i];
            if (r.transient || !r.image || upTo(2) == 0) {
                continue;
            }
            r.held = true;
            r.offset = ends[r.heap];
            ends[r.heap] += r.size;
            const gpu::HeldUse use = r.undefined    ? gpu::HeldUse::fromFirst
                                     : upTo(2) == 0 ? gpu::HeldUse::busy
                                                    : gpu::HeldUse::untilLast;
            graph.heaps[r.heap].held.push_back({{r.offset, r.size}, use, i});
        }
        for (gpu::GraphHeap& heap : graph.heaps) {
            if (upTo(3) == 0) {
                heap.held.push_back({{6000, 300}, static_cast<gpu::HeldUse>(upTo(3)), gpu::HeldRange::unused});
            }
        }
    }

    void addPass() {
        std::vector<uint32_t> chosen(graph.resources.size());
        std::iota(chosen.begin(), chosen.end(), 0U);
        std::ranges::shuffle(chosen, random_);
        chosen.resize(std::min<size_t>(chosen.size(), 1 + upTo(5)));
        graph.passes.push_back(
            {static_cast<uint32_t>(graph.uses.size()), static_cast<uint32_t>(chosen.size()), upTo(5) == 0});
        for (const uint32_t r : chosen) {
            graph.uses.push_back({r, kind(7)});
        }
    }

    std::mt19937 random_;
};

TEST(Plan, TenThousandRandomListsAreRight) {
    for (uint32_t seed = 1; seed <= 10000; ++seed) {
        PassGraph graph = RandomGraph(seed).graph;
        graph.order = seed % 4 == 0 ? gpu::PassOrder::asListed : gpu::PassOrder::byLevel;
        const std::string fault = faultOf(graph, compile(graph));
        ASSERT_EQ(fault, "") << "seed " << seed;
    }
}

// The checker itself: a plan with anything taken away is wrong.
TEST(Plan, TheCheckerFindsWhatIsMissing) {
    uint32_t found = 0;
    uint32_t tried = 0;
    for (uint32_t seed = 1; seed <= 200; ++seed) {
        const PassGraph graph = RandomGraph(seed).graph;
        const Plan right = compile(graph);
        for (size_t i = 0; i < right.barriers.size(); ++i) {
            Plan wrong = right;
            wrong.barriers.erase(wrong.barriers.begin() + static_cast<std::ptrdiff_t>(i));
            ++tried;
            found += faultOf(graph, wrong).empty() ? 0 : 1;
        }
        Plan less = right;
        if (!less.order.empty()) {
            less.order.pop_back();
            ++tried;
            found += faultOf(graph, less).empty() ? 0 : 1;
        }
    }
    EXPECT_EQ(found, tried);
    EXPECT_GT(tried, 1000U);
}

}  // namespace
}  // namespace reflet::test::plan_test
