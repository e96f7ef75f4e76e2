// Basic blocks are `BBn:`, instructions begin with a tab; a branch to an earlier block closes a loop.
#include "gpu_compilers/isa.h"

#include <algorithm>
#include <map>
#include <utility>

namespace reflet::gpu_compilers {

namespace {

struct Line {
    std::string_view operation;
    std::string_view arguments;
};

struct Block {
    std::string_view name;
    std::vector<Line> lines;
};

bool startsWithAny(std::string_view text, auto... prefixes) {
    return (text.starts_with(prefixes) || ...);
}

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

std::vector<Block> blocksOf(std::string_view assembly) {
    std::vector<Block> blocks;
    while (!assembly.empty()) {
        const size_t end = std::min(assembly.find('\n'), assembly.size());
        std::string_view line = assembly.substr(0, end);
        assembly.remove_prefix(std::min(end + 1, assembly.size()));
        line = line.substr(0, line.find(';'));
        line = line.substr(0, line.find_last_not_of(" \r") + 1);
        if (line.starts_with("BB") && contains(line, ":")) {
            blocks.push_back({line.substr(0, line.find(':')), {}});
        } else if (line.starts_with('\t') && !blocks.empty()) {
            line.remove_prefix(1);
            const size_t space = std::min(line.find(' '), line.size());
            blocks.back().lines.push_back({line.substr(0, space), line.substr(space)});
        }
    }
    return blocks;
}

// issued: whether memory was read since the last wait: further waits for the same loads take little.
void count(Instructions& to, const Line& line, bool& issued) {
    const std::string_view op = line.operation;
    if (op.starts_with("s_waitcnt")) {
        const bool waits = issued && contains(line.arguments, "vmcnt");
        to.memoryWaits += waits ? 1 : 0;
        issued = issued && !waits;
        to.sharedWaits += contains(line.arguments, "lgkm") ? 1 : 0;
    } else if (op.starts_with("v_")) {
        ++(startsWithAny(op, "v_rcp", "v_rsq", "v_sqrt", "v_exp", "v_log", "v_sin", "v_cos") ? to.transcendental
                                                                                             : to.vector);
    } else if (startsWithAny(op, "image_", "buffer_", "global_", "scratch_")) {
        issued = issued || !contains(op, "store");
        ++(contains(op, "store")                                          ? to.stores
           : contains(op, "atomic")                                       ? to.atomics
           : contains(op, "image_sample") || contains(op, "image_gather") ? to.samples
                                                                          : to.loads);
    } else if (startsWithAny(op, "s_load", "s_buffer")) {
        ++to.constants;
    } else {
        ++(op.starts_with("ds_") ? to.shared : to.scalar);
    }
}

// First block of each loop: the last one that branches back to it.
std::map<size_t, size_t> rangesOf(const std::vector<Block>& blocks) {
    std::map<std::string_view, size_t> places;
    for (size_t i = 0; i < blocks.size(); ++i) {
        places.emplace(blocks[i].name, i);
    }
    std::map<size_t, size_t> ranges;
    for (size_t i = 0; i < blocks.size(); ++i) {
        for (const Line& line : blocks[i].lines) {
            if (!startsWithAny(line.operation, "s_branch", "s_cbranch")) {
                continue;
            }
            const std::string_view target = line.arguments.substr(line.arguments.rfind(' ') + 1);
            const auto known = places.find(target);
            if (known != places.end() && known->second <= i) {
                size_t& last = ranges[known->second];
                last = std::max(last, i);
            }
        }
    }
    return ranges;
}

}  // namespace

std::vector<Loop> loopsOf(std::string_view assembly) {
    const std::vector<Block> blocks = blocksOf(assembly);
    std::vector<Loop> loops(1);
    std::vector<std::pair<size_t, size_t>> ranges{{0, blocks.size()}};
    const auto innermostAt = [&](size_t block) {
        size_t found = 0;
        for (size_t i = 1; i < ranges.size(); ++i) {  // by first block, so that the last one that fits is innermost
            if (ranges[i].first <= block && block <= ranges[i].second) {
                found = i;
            }
        }
        return found;
    };
    for (const auto& [first, last] : rangesOf(blocks)) {
        const size_t parent = innermostAt(first);
        loops[parent].innermost = false;
        loops.push_back({static_cast<int>(parent), true, {}});
        ranges.emplace_back(first, last);
    }
    bool issued = false;
    for (size_t i = 0; i < blocks.size(); ++i) {
        Instructions& to = loops[innermostAt(i)].instructions;
        for (const Line& line : blocks[i].lines) {
            count(to, line, issued);
        }
    }
    return loops;
}

uint32_t innerLoop(const std::vector<Loop>& loops) {
    uint32_t most = 0;
    for (size_t i = 1; i < loops.size(); ++i) {
        most = loops[i].innermost ? std::max(most, loops[i].instructions.sum()) : most;
    }
    return most;
}

}  // namespace reflet::gpu_compilers
