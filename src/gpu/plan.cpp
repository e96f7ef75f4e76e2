// Orders, places and synchronizes a list of passes.
#include "gpu/plan.h"

#include "base/error.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace reflet::gpu {

namespace {

constexpr VkAccessFlags2 writeAccess = VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                       VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
constexpr int64_t beforeList = -1;

std::span<const ResourceUse> usesOf(const PassGraph& graph, uint32_t pass) {
    return std::span(graph.uses).subspan(graph.passes[pass].firstUse, graph.passes[pass].useCount);
}

// A pass is needed if it is a root, writes what outlives the list, or writes what a needed pass uses. What a pass
// writes may be partly what was there before, so an earlier writer is needed by a later one.
std::vector<bool> neededPasses(const PassGraph& graph) {
    std::vector<bool> wanted(graph.resources.size());
    for (size_t r = 0; r < wanted.size(); ++r) {
        wanted[r] = !graph.resources[r].transient || graph.resources[r].output;
    }
    std::vector<bool> needed(graph.passes.size());
    for (uint32_t p = static_cast<uint32_t>(graph.passes.size()); p-- > 0;) {
        const auto uses = usesOf(graph, p);
        needed[p] = graph.passes[p].root || std::ranges::any_of(uses, [&](const ResourceUse& u) {
                        return u.access.write && wanted[u.resource];
                    });
        for (const ResourceUse& u : uses) {
            wanted[u.resource] = wanted[u.resource] || needed[p];
        }
    }
    return needed;
}

// Longest chain of passes that each pass has to wait for.
std::vector<uint32_t> levelsOf(const PassGraph& graph, const std::vector<bool>& needed) {
    struct Last {
        uint32_t afterWrite = 0;  // the level from which the last write can be read
        uint32_t afterReads = 0;  // the level from which it can be written again
    };
    std::vector<Last> last(graph.resources.size());
    std::vector<uint32_t> levels(graph.passes.size());
    for (uint32_t p = 0; p < graph.passes.size(); ++p) {
        if (!needed[p]) {
            continue;
        }
        for (const ResourceUse& u : usesOf(graph, p)) {
            const Last& l = last[u.resource];
            levels[p] = std::max(levels[p], u.access.write ? std::max(l.afterWrite, l.afterReads) : l.afterWrite);
        }
        for (const ResourceUse& u : usesOf(graph, p)) {
            Last& l = last[u.resource];
            if (u.access.write) {
                l = {levels[p] + 1, 0};
            } else {
                l.afterReads = std::max(l.afterReads, levels[p] + 1);
            }
        }
    }
    return levels;
}

void orderPasses(const PassGraph& graph, Plan& plan) {
    const std::vector<bool> needed = neededPasses(graph);
    const std::vector<uint32_t> levels = levelsOf(graph, needed);
    for (uint32_t p = 0; p < graph.passes.size(); ++p) {
        if (needed[p]) {
            plan.order.push_back(p);
        }
    }
    if (graph.order == PassOrder::byLevel) {
        std::ranges::stable_sort(plan.order, {}, [&](uint32_t p) { return levels[p]; });
        std::ranges::transform(plan.order, std::back_inserter(plan.levels), [&](uint32_t p) { return levels[p]; });
    } else {
        plan.levels.resize(plan.order.size());
        std::iota(plan.levels.begin(), plan.levels.end(), 0U);
    }
    plan.lifetimes.resize(graph.resources.size());
    for (uint32_t i = 0; i < plan.order.size(); ++i) {
        for (const ResourceUse& u : usesOf(graph, plan.order[i])) {
            Lifetime& life = plan.lifetimes[u.resource];
            life.first = std::min(life.first, i);
            life.last = i;
        }
    }
    for (size_t r = 0; r < graph.resources.size(); ++r) {
        if (graph.resources[r].output && plan.lifetimes[r].first != UINT32_MAX) {
            plan.lifetimes[r].last = static_cast<uint32_t>(plan.order.size());  // it stays
        }
    }
}

// The lowest offset in a heap that is free of `busy` and within one block.
VkDeviceSize freeOffset(const GraphHeap& heap, std::vector<MemoryRange> busy, VkDeviceSize size,
                        VkDeviceSize alignment) {
    std::ranges::sort(busy, {}, &MemoryRange::offset);
    VkDeviceSize start = 0;  // of the block
    for (size_t block = 0;; ++block) {
        const bool open = block == heap.blocks.size();
        const VkDeviceSize end = open ? Plan::unplaced : start + heap.blocks[block];
        VkDeviceSize at = alignUp(start, alignment);
        for (const MemoryRange& b : busy) {
            if (b.offset + b.size <= at) {
                continue;
            }
            if (b.offset >= at + size) {
                break;
            }
            at = alignUp(b.offset + b.size, alignment);
        }
        if (open || at + size <= end) {
            return at;
        }
        start = end;
    }
}

// Whether two resources are used at the same time. Passes of one level run side by side: memory that they shared would
// need a barrier between them.
uint32_t levelAt(const Plan& plan, uint32_t position) {
    return position < plan.levels.size() ? plan.levels[position] : UINT32_MAX;
}

bool liveTogether(const Plan& plan, const Lifetime& a, const Lifetime& b) {
    return levelAt(plan, a.first) <= levelAt(plan, b.last) && levelAt(plan, b.first) <= levelAt(plan, a.last);
}

// Whether a resource must stay out of memory that is held.
bool conflicts(const PassGraph& graph, const Plan& plan, const HeldRange& held, uint32_t resource) {
    const Lifetime& life = plan.lifetimes[resource];
    const bool used = held.resource != HeldRange::unused && plan.lifetimes[held.resource].first != UINT32_MAX;
    switch (held.use) {
        case HeldUse::untilLast:
            return used && levelAt(plan, life.first) <= levelAt(plan, plan.lifetimes[held.resource].last);
        case HeldUse::fromFirst:
            return graph.resources[resource].output ||
                   (used && levelAt(plan, life.last) >= levelAt(plan, plan.lifetimes[held.resource].first));
        default:
            return true;
    }
}

// The largest first: what is small fits into the holes.
void place(const PassGraph& graph, Plan& plan) {
    plan.offsets.assign(graph.resources.size(), Plan::unplaced);
    plan.ends.assign(graph.heaps.size(), 0);
    std::vector<uint32_t> bySize;
    for (uint32_t r = 0; r < graph.resources.size(); ++r) {
        if (graph.resources[r].transient && plan.lifetimes[r].first != UINT32_MAX) {
            bySize.push_back(r);
        }
    }
    std::ranges::stable_sort(bySize, std::greater(), [&](uint32_t r) { return graph.resources[r].size; });
    for (size_t i = 0; i < bySize.size(); ++i) {
        const uint32_t r = bySize[i];
        const GraphResource& resource = graph.resources[r];
        std::vector<MemoryRange> busy = graph.heaps[resource.heap].taken;
        for (const HeldRange& held : graph.heaps[resource.heap].held) {
            if (conflicts(graph, plan, held, r)) {
                busy.push_back(held.range);
            }
        }
        for (size_t k = 0; k < i; ++k) {
            const uint32_t other = bySize[k];
            if (graph.resources[other].heap == resource.heap &&
                liveTogether(plan, plan.lifetimes[other], plan.lifetimes[r])) {
                busy.push_back({plan.offsets[other], graph.resources[other].size});
            }
        }
        plan.offsets[r] = freeOffset(graph.heaps[resource.heap], std::move(busy), resource.size, resource.alignment);
        VkDeviceSize& end = plan.ends[resource.heap];
        end = std::max(end, plan.offsets[r] + resource.size);
    }
}

// What a use has to wait for: where it was, and how it was accessed. access: writes only, as reads need no memory
// dependency.
struct Source {
    int64_t position = beforeList;
    Access access;
};

class Synchronization {
public:
    Synchronization(const PassGraph& graph, Plan& plan) : graph_(graph), plan_(plan), states_(graph.resources.size()) {
        for (size_t r = 0; r < states_.size(); ++r) {
            const AccessState& before = graph.resources[r].before;
            State& state = states_[r];
            state.write = {beforeList, {before.writeStages, before.writeAccess, true}};
            if (before.readStages != 0) {
                state.reads.push_back({beforeList, {before.readStages, 0, false}});
            }
            state.visibleBefore = {before.visibleStages, before.visibleAccess, false};
        }
    }

    void run() {
        for (uint32_t i = 0; i < plan_.order.size(); ++i) {
            for (const ResourceUse& u : usesOf(graph_, plan_.order[i])) {
                use(i, u);
            }
        }
        finish();
    }

private:
    struct State {
        Source write;               // the last one
        std::vector<Source> reads;  // since then
        Access visibleBefore;       // of a write before the list: to whom it is visible already
    };

    // Several passes of one position do not exist: `position` is a pass of its own.
    void use(uint32_t position, const ResourceUse& u) {
        State& state = states_[u.resource];
        const GraphResource& resource = graph_.resources[u.resource];
        const bool first = plan_.lifetimes[u.resource].first == position;
        if (first && resource.transient) {
            const std::vector<Source> sources = formerOccupants(u.resource);
            begin(position, u, sources, state);
        } else if (first && resource.undefined) {
            std::vector<Source> sources;
            if (resource.held) {
                sources = formerOccupants(u.resource);
                if (state.write.access.stages != 0) {
                    sources.push_back(state.write);
                }
                sources.insert(sources.end(), state.reads.begin(), state.reads.end());
                state.reads.clear();
            }
            begin(position, u, sources, state);
        } else {
            wait(position, state.write, u.access, state.visibleBefore);
            if (u.access.write) {
                for (const Source& read : state.reads) {
                    wait(position, read, u.access, {});
                }
            }
        }
        note(position, u, state);
    }

    void note(uint32_t position, const ResourceUse& u, State& state) {
        const Source source{position, {u.access.stages, u.access.access & writeAccess, u.access.write}};
        if (u.access.write) {
            state.write = source;
            state.reads.clear();
            state.visibleBefore = {};
        } else {
            state.reads.push_back({position, {u.access.stages, 0, false}});
        }
    }

    VkDeviceSize offsetOf(size_t r) const {
        return graph_.resources[r].held ? graph_.resources[r].offset : plan_.offsets[r];
    }

    // The last uses of whatever was in the memory before.
    std::vector<Source> formerOccupants(uint32_t r) const {
        const GraphResource& resource = graph_.resources[r];
        std::vector<Source> sources;
        const Access& before = graph_.heaps[resource.heap].before;
        if (before.stages != 0) {
            sources.push_back({beforeList, before});
        }
        for (size_t other = 0; other < states_.size(); ++other) {
            const GraphResource& o = graph_.resources[other];
            if (other == r || (!o.transient && !o.held) || o.heap != resource.heap ||
                plan_.lifetimes[other].first == UINT32_MAX || plan_.lifetimes[other].last >= plan_.lifetimes[r].first ||
                offsetOf(other) + o.size <= offsetOf(r) || offsetOf(r) + resource.size <= offsetOf(other)) {
                continue;
            }
            if (states_[other].write.access.stages != 0) {
                sources.push_back(states_[other].write);
            }
            sources.insert(sources.end(), states_[other].reads.begin(), states_[other].reads.end());
        }
        return sources;
    }

    // The first use of what has no contents: waits, and brings an image into its layout.
    void begin(uint32_t position, const ResourceUse& u, const std::vector<Source>& sources, State& state) {
        for (const Source& source : sources) {
            wait(position, source, u.access, {});
        }
        if (!graph_.resources[u.resource].image) {
            return;
        }
        int64_t latest = beforeList;
        Access from;
        for (const Source& source : sources) {
            latest = std::max(latest, source.position);
            from = merged(from, source.access);
        }
        PlannedBarrier& barrier = barrierAfter(latest, position);
        barrier.transitions.push_back({u.resource, from, u.access});
        // A transition is a write that the first use sees. Others wait for it, behind its barrier.
        state.write = {int64_t(barrier.before), {u.access.stages, 0, true}};
        state.visibleBefore = {u.access.stages, u.access.access, false};
    }

    // Makes a barrier stand between a source and a use. visible: to whom the source is visible without any.
    void wait(uint32_t position, const Source& source, const Access& access, const Access& visible) {
        if (source.access.stages == 0) {
            return;
        }
        const auto covers = [](const Access& a, VkPipelineStageFlags2 stages, VkAccessFlags2 bits) {
            return (a.stages & stages) == stages && (a.access & bits) == bits;
        };
        const bool readsOnly = !source.access.write;
        if (!readsOnly && !access.write && visible.stages != 0 && covers(visible, access.stages, access.access)) {
            return;
        }
        for (auto b = plan_.barriers.rbegin(); b != plan_.barriers.rend() && int64_t(b->before) > source.position;
             ++b) {
            if (covers(b->from, source.access.stages, source.access.access) &&
                covers(b->to, access.stages, access.access)) {
                return;
            }
        }
        PlannedBarrier& barrier = barrierAfter(source.position, position);
        barrier.from = merged(barrier.from, source.access);
        barrier.to = merged(barrier.to, access);
    }

    // The last barrier before `position`, if it stands behind `source`; otherwise a new one.
    PlannedBarrier& barrierAfter(int64_t source, uint32_t position) {
        if (plan_.barriers.empty() || int64_t(plan_.barriers.back().before) <= source) {
            plan_.barriers.push_back({position, {}, {}, {}});
        }
        return plan_.barriers.back();
    }

    void finish() {
        plan_.after.resize(states_.size());
        for (size_t r = 0; r < states_.size(); ++r) {
            const State& state = states_[r];
            AccessState& after = plan_.after[r];
            after.writeStages = state.write.access.stages;
            after.writeAccess = state.write.access.access;
            after.visibleStages = state.visibleBefore.stages;
            after.visibleAccess = state.visibleBefore.access;
            for (const Source& read : state.reads) {
                after.readStages |= read.access.stages;
            }
            for (const PlannedBarrier& b : plan_.barriers) {
                const bool sees = (b.from.stages & after.writeStages) == after.writeStages &&
                                  (b.from.access & after.writeAccess) == after.writeAccess;
                if (after.writeStages != 0 && int64_t(b.before) > state.write.position && sees) {
                    after.visibleStages |= b.to.stages;
                    after.visibleAccess |= b.to.access;
                }
            }
        }
    }

    const PassGraph& graph_;
    Plan& plan_;
    std::vector<State> states_;
};

}  // namespace

Access merged(const Access& a, const Access& b) {
    return {a.stages | b.stages, a.access | b.access, a.write || b.write};
}

Plan compile(const PassGraph& graph) {
    for (const ResourceUse& u : graph.uses) {
        REFLET_CHECK(u.resource < graph.resources.size(), "resource {} of {}", u.resource, graph.resources.size());
    }
    Plan plan;
    orderPasses(graph, plan);
    place(graph, plan);
    Synchronization(graph, plan).run();
    return plan;
}

}  // namespace reflet::gpu
