// Writes listings of passes.
#include "cli/pass_listing.h"

#include "base/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
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

// What one pass hands to another.
struct Edge {
    size_t from = 0;
    size_t to = 0;
    std::string label;
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
        for (const auto& [from, names] : resources) {
            edges.push_back({from, to, fmt::format("{}", fmt::join(names, ", "))});
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

// Without the scope that its group's title says.
std::string_view titleOf(std::string_view pass) {
    const std::string_view scope = scopeOf(pass);
    return scope.empty() ? pass : pass.substr(scope.size() + 1);
}

// What the two kinds of diagram differ in.
struct Diagram {
    std::string_view begin;
    std::string_view end;
    std::string (*beginGroup)(std::string_view scope);
    std::string_view endGroup;
    std::string (*pass)(size_t index, std::string_view title, bool raster);
    std::string (*edge)(const Edge& edge);
};

std::string drawn(const gpu::PassListing& listing, const Diagram& diagram) {
    std::string text(diagram.begin);
    for (const auto& [scope, passes] : groupsOf(listing)) {
        text += scope.empty() ? "" : diagram.beginGroup(scope);
        for (const size_t i : passes) {
            text += scope.empty() ? "    " : "        ";
            text += diagram.pass(i, titleOf(listing.passes[i].name), listing.passes[i].raster);
        }
        text += scope.empty() ? "" : diagram.endGroup;
    }
    for (const Edge& edge : edgesOf(listing)) {
        text += "    " + diagram.edge(edge);
    }
    return text + std::string(diagram.end);
}

}  // namespace

std::string passesAsMarkdown(const gpu::PassListing& listing) {
    return markdownOf({Section{"Passes", {}, passTable(listing)}, Section{"Resources", {}, resourceTable(listing)}});
}

std::string passesAsMermaid(const gpu::PassListing& listing) {
    return drawn(listing, {.begin = "flowchart LR\n",
                           .end = "",
                           .beginGroup = [](std::string_view scope) { return fmt::format("    subgraph {}\n", scope); },
                           .endGroup = "    end\n",
                           .pass =
                               [](size_t index, std::string_view title, bool raster) {
                                   return raster ? fmt::format("p{}([\"{}\"])\n", index, title)
                                                 : fmt::format("p{}[\"{}\"]\n", index, title);
                               },
                           .edge =
                               [](const Edge& edge) {
                                   return fmt::format("p{} -->|\"{}\"| p{}\n", edge.from, edge.label, edge.to);
                               }});
}

std::string passesAsDot(const gpu::PassListing& listing) {
    return drawn(listing,
                 {.begin = "digraph frame {\n    rankdir=LR;\n    node [shape=box];\n",
                  .end = "}\n",
                  .beginGroup =
                      [](std::string_view scope) {
                          return fmt::format("    subgraph \"cluster_{0}\" {{\n        label=\"{0}\";\n", scope);
                      },
                  .endGroup = "    }\n",
                  .pass =
                      [](size_t index, std::string_view title, bool raster) {
                          return fmt::format("p{} [label=\"{}\"{}];\n", index, title, raster ? ", shape=oval" : "");
                      },
                  .edge =
                      [](const Edge& edge) {
                          return fmt::format("p{} -> p{} [label=\"{}\"];\n", edge.from, edge.to, edge.label);
                      }});
}

}  // namespace reflet
