// Writes listings of passes.
#include "cli/pass_listing.h"

#include "base/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

namespace reflet {

namespace {

using Pass = gpu::PassListing::Pass;
using Resource = gpu::PassListing::Resource;

std::string megabytesOf(uint64_t bytes) {
    return fmt::format("{:.2f}", static_cast<double>(bytes) / 1e6);
}

Phrase codeOf(const std::vector<std::string>& names) {
    return names.empty() ? Phrase() : asCode(fmt::format("{}", fmt::join(names, ", ")));
}

TextTable passTable(const gpu::PassListing& listing) {
    TextTable table{{{"pass"}, {"kind"}, {"level", true}, {"reads"}, {"writes"}, {"MB", true}}, {}};
    for (const Pass& pass : listing.passes) {
        table.rows.push_back({asCode(pass.name), pass.raster ? "raster" : "compute", std::to_string(pass.level),
                              codeOf(pass.reads), codeOf(pass.writes), megabytesOf(pass.bytes)});
    }
    return table;
}

std::string lifeText(const Resource& resource, const std::vector<Pass>& passes) {
    if (resource.first < 0) {
        return "kept";
    }
    const std::string& first = passes.at(static_cast<size_t>(resource.first)).name;
    const std::string& last = passes.at(static_cast<size_t>(resource.last)).name;
    return first == last ? first : first + " to " + last;
}

TextTable resourceTable(const gpu::PassListing& listing) {
    TextTable table{{{"resource"}, {"format"}, {"size"}, {"MB", true}, {"life"}, {"offset, MB", true}}, {}};
    for (const Resource& resource : listing.resources) {
        const bool isImage = !resource.format.empty();
        table.rows.push_back({asCode(resource.name), isImage ? resource.format : "buffer",
                              isImage ? fmt::format("{}x{}", resource.size.x, resource.size.y) : "",
                              megabytesOf(resource.bytes), lifeText(resource, listing.passes),
                              resource.first < 0 ? "" : megabytesOf(resource.offset)});
    }
    return table;
}

// "diffuse" of "diffuse.trace_screen"; "": none.
std::string_view scopeOf(std::string_view pass) {
    const size_t dot = pass.find('.');
    return dot == std::string_view::npos ? std::string_view() : pass.substr(0, dot);
}

// Without the scope that its group's title says.
std::string_view titleOf(std::string_view pass) {
    const std::string_view scope = scopeOf(pass);
    return scope.empty() ? pass : pass.substr(scope.size() + 1);
}

// What one pass hands to another.
struct Edge {
    size_t from = 0;
    size_t to = 0;
    std::vector<std::string> names;
};

// One for each pair of passes, in the order of `to`. What no earlier pass has written comes from the frame before or
// from outside, and has none.
std::vector<Edge> edgesOf(const gpu::PassListing& listing) {
    std::map<std::string_view, size_t> writers;
    std::vector<Edge> edges;
    for (size_t to = 0; to < listing.passes.size(); ++to) {
        const Pass& pass = listing.passes[to];
        std::map<size_t, std::vector<std::string>> resources;  // by the pass that they come from
        for (const std::string& name : pass.reads) {
            if (const auto writer = writers.find(name); writer != writers.end()) {
                resources[writer->second].push_back(name);
            }
        }
        for (auto& [from, names] : resources) {
            edges.push_back({from, to, std::move(names)});
        }
        for (const std::string& name : pass.writes) {
            writers[name] = to;
        }
    }
    return edges;
}

// Passes by scope; both in the order in which they come first.
std::vector<std::pair<std::string_view, std::vector<size_t>>> groupsOf(const gpu::PassListing& listing) {
    std::vector<std::pair<std::string_view, std::vector<size_t>>> groups;
    for (size_t i = 0; i < listing.passes.size(); ++i) {
        const std::string_view scope = scopeOf(listing.passes[i].name);
        auto group = std::ranges::find_if(groups, [&](const auto& g) { return g.first == scope; });
        if (group == groups.end()) {
            group = groups.insert(groups.end(), {scope, {}});
        }
        group->second.push_back(i);
    }
    return groups;
}

// "planar" of "planar0".
std::string_view withoutNumber(std::string_view scope) {
    return scope.substr(0, scope.find_last_not_of("0123456789") + 1);
}

void addOnce(std::vector<std::string>& names, std::string_view name) {
    if (std::ranges::find(names, name) == names.end()) {
        names.emplace_back(name);
    }
}

// Passes of one scope, and of scopes that differ in their number only, as one step of the frame.
struct Step {
    std::string_view name;
    std::vector<std::string> scopes;  ///< that are its own; empty: a pass without a scope
    std::vector<std::string> passes;  ///< in it; a scope within the scope is one of these
    bool raster = true;               ///< all of it
};

// The steps, and those of these that each pass belongs to. Copies of values to the device and clears have none.
struct Steps {
    static constexpr size_t none = ~size_t(0);

    std::vector<Step> steps;
    std::vector<size_t> ofPass;
};

Steps stepsOf(const gpu::PassListing& listing) {
    Steps all;
    for (const Pass& pass : listing.passes) {
        const std::string_view last = std::string_view(pass.name).substr(pass.name.rfind('.') + 1);
        if (last == "update" || last == "clear" || last == "upload") {
            all.ofPass.push_back(Steps::none);
            continue;
        }
        const std::string_view scope = scopeOf(pass.name);
        const std::string_view name = scope.empty() ? std::string_view(pass.name) : withoutNumber(scope);
        auto step = std::ranges::find(all.steps, name, &Step::name);
        if (step == all.steps.end()) {
            step = all.steps.insert(all.steps.end(), Step{.name = name, .scopes = {}, .passes = {}});
        }
        if (!scope.empty()) {
            addOnce(step->scopes, scope);
            const std::string_view title = titleOf(pass.name);
            addOnce(step->passes, title.substr(0, title.find('.')));
        }
        step->raster = step->raster && pass.raster;
        all.ofPass.push_back(static_cast<size_t>(step - all.steps.begin()));
    }
    return all;
}

// What steps hand to each other: one edge for each pair, in the order of `to`. Names have no scope that is the step's.
std::vector<Edge> edgesOf(const gpu::PassListing& listing, const Steps& steps) {
    std::vector<Edge> ofPasses = edgesOf(listing);
    std::ranges::sort(ofPasses, [](const Edge& a, const Edge& b) {  // what was written last is named first
        return a.to != b.to ? a.to < b.to : a.from > b.from;
    });
    std::map<std::pair<size_t, size_t>, Edge> edges;  // by `to` and `from`
    for (const Edge& edge : ofPasses) {
        const size_t from = steps.ofPass[edge.from];
        const size_t to = steps.ofPass[edge.to];
        if (from == to || from == Steps::none || to == Steps::none) {
            continue;
        }
        Edge& one = edges.try_emplace({to, from}, Edge{from, to, {}}).first->second;
        for (const std::string& name : edge.names) {
            const bool own =
                std::ranges::find(steps.steps[from].scopes, scopeOf(name)) != steps.steps[from].scopes.end();
            addOnce(one.names, own ? titleOf(name) : std::string_view(name));
        }
    }
    std::vector<Edge> list;
    std::ranges::transform(edges, std::back_inserter(list), [](const auto& edge) { return edge.second; });
    return list;
}

// In lines of a box, the names of its passes.
std::string linesOf(const std::vector<std::string>& names) {
    constexpr size_t width = 36;
    std::string text;
    size_t length = width;
    for (const std::string& name : names) {
        const bool fits = length + name.size() + 2 <= width;
        text += (fits ? ", " : text.empty() ? "<br>" : ",<br>") + name;
        length = fits ? length + name.size() + 2 : name.size();
    }
    return text;
}

std::string boxOf(size_t index, const Step& step) {
    const std::string title =
        step.scopes.empty() ? std::string(step.name) : fmt::format("{}", fmt::join(step.scopes, ", "));
    const std::string label = step.passes.empty() ? title : fmt::format("<b>{}</b>{}", title, linesOf(step.passes));
    return step.raster ? fmt::format("s{}([\"{}\"])", index, label) : fmt::format("s{}[\"{}\"]", index, label);
}

std::string labelOf(const Edge& edge) {
    constexpr size_t most = 3;
    const size_t shown = std::min(edge.names.size(), most);
    return fmt::format("{}{}", fmt::join(edge.names.begin(), edge.names.begin() + static_cast<ptrdiff_t>(shown), ", "),
                       shown < edge.names.size() ? ", …" : "");
}

}  // namespace

std::string passesAsMarkdown(const gpu::PassListing& listing) {
    return markdownOf({Section{"Passes", {}, passTable(listing)}, Section{"Resources", {}, resourceTable(listing)}});
}

std::string passesAsMermaid(const gpu::PassListing& listing) {
    const Steps steps = stepsOf(listing);
    std::string text = "flowchart TD\n";
    for (size_t i = 0; i < steps.steps.size(); ++i) {
        text += fmt::format("    {}\n", boxOf(i, steps.steps[i]));
    }
    for (const Edge& edge : edgesOf(listing, steps)) {
        text += fmt::format("    s{} -->|\"{}\"| s{}\n", edge.from, labelOf(edge), edge.to);
    }
    return text;
}

std::string passesAsDot(const gpu::PassListing& listing) {
    std::string text = "digraph frame {\n    rankdir=LR;\n    node [shape=box];\n";
    for (const auto& [scope, passes] : groupsOf(listing)) {
        if (!scope.empty()) {
            text += fmt::format("    subgraph \"cluster_{0}\" {{\n        label=\"{0}\";\n", scope);
        }
        for (const size_t i : passes) {
            text += fmt::format("{}p{} [label=\"{}\"{}];\n", scope.empty() ? "    " : "        ", i,
                                titleOf(listing.passes[i].name), listing.passes[i].raster ? ", shape=oval" : "");
        }
        text += scope.empty() ? "" : "    }\n";
    }
    for (const Edge& edge : edgesOf(listing)) {
        text += fmt::format("    p{} -> p{} [label=\"{}\"];\n", edge.from, edge.to, fmt::join(edge.names, ", "));
    }
    return text + "}\n";
}

}  // namespace reflet
