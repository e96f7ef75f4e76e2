// The passes of a frame as tables and as diagrams.
#include "cli/pass_listing.h"

#include <gtest/gtest.h>

namespace reflet::pass_listing_test {
namespace {

// gbuffer, then a lobe in two passes, one of which overwrites what the other has read.
gpu::PassListing sample() {
    return {{{.name = "gbuffer", .raster = true, .reads = {}, .writes = {"depth", "normal"}, .bytes = 3'000'000},
             {.name = "diffuse.trace",
              .reads = {"depth", "normal", "history"},
              .writes = {"rays"},
              .bytes = 2'500'000,
              .level = 1},
             {.name = "diffuse.resolve", .reads = {"rays"}, .writes = {"rays", "history"}, .level = 2},
             {.name = "composite", .reads = {"rays", "depth"}, .writes = {"lit"}, .level = 3}},
            {{.name = "depth", .format = "D32", .size = {160, 90}, .bytes = 57'600, .first = 0, .last = 3},
             {.name = "rays", .bytes = 1'000'000, .first = 1, .last = 3, .offset = 2'000'000},
             {.name = "history", .format = "RGBA16F", .size = {160, 90}, .bytes = 115'200}}};
}

TEST(PassListing, AsMarkdownHasATableOfPassesAndOneOfResources) {
    EXPECT_EQ(passesAsMarkdown(sample()),
              "### Passes\n\n"
              "| pass | kind | level | reads | writes | MB |\n|---|---|--:|---|---|--:|\n"
              "| `gbuffer` | raster | 0 | | `depth, normal` | 3.00 |\n"
              "| `diffuse.trace` | compute | 1 | `depth, normal, history` | `rays` | 2.50 |\n"
              "| `diffuse.resolve` | compute | 2 | `rays` | `rays, history` | 0.00 |\n"
              "| `composite` | compute | 3 | `rays, depth` | `lit` | 0.00 |\n"
              "\n### Resources\n\n"
              "| resource | format | size | MB | life | offset, MB |\n|---|---|---|--:|---|--:|\n"
              "| `depth` | D32 | 160x90 | 0.06 | gbuffer to composite | 0.00 |\n"
              "| `rays` | buffer | | 1.00 | diffuse.trace to composite | 2.00 |\n"
              "| `history` | RGBA16F | 160x90 | 0.12 | kept | |\n");
}

TEST(PassListing, AsMermaidHasABoxForEachScopeAndLabelsEdgesByResource) {
    EXPECT_EQ(passesAsMermaid(sample()),
              "flowchart TD\n"
              "    s0([\"gbuffer\"])\n"
              "    s1[\"<b>diffuse</b><br>trace, resolve\"]\n"
              "    s2[\"composite\"]\n"
              "    s0 -->|\"depth, normal\"| s1\n"
              "    s0 -->|\"depth\"| s2\n"
              "    s1 -->|\"rays\"| s2\n");
}

// Scopes that differ in their number are one box; clears have none; an edge has three names at most.
TEST(PassListing, AsMermaidIsShort) {
    const gpu::PassListing listing{
        {{.name = "planar0.gbuffer", .raster = true, .reads = {}, .writes = {"planar0.depth"}},
         {.name = "planar0.specular.clear", .reads = {}, .writes = {"planar0.rays"}},
         {.name = "planar1.gbuffer", .raster = true, .reads = {}, .writes = {"planar1.depth", "a", "b"}},
         {.name = "planar1.pyramid.1", .reads = {"planar1.depth"}, .writes = {"c"}},
         {.name = "planar1.pyramid.2", .reads = {"c"}, .writes = {"planar1.c.d"}},
         {.name = "trace",
          .reads = {"planar0.depth", "planar0.rays", "planar1.depth", "a", "b", "planar1.c.d"},
          .writes = {}}},
        {}};
    EXPECT_EQ(passesAsMermaid(listing),
              "flowchart TD\n"
              "    s0[\"<b>planar0, planar1</b><br>gbuffer, pyramid\"]\n"
              "    s1[\"trace\"]\n"
              "    s0 -->|\"c.d, depth, a, …\"| s1\n");
}

TEST(PassListing, AsDotGroupsScopesAndHasAllPasses) {
    EXPECT_EQ(passesAsDot(sample()),
              "digraph frame {\n"
              "    rankdir=LR;\n"
              "    node [shape=box];\n"
              "    p0 [label=\"gbuffer\", shape=oval];\n"
              "    p3 [label=\"composite\"];\n"
              "    subgraph \"cluster_diffuse\" {\n"
              "        label=\"diffuse\";\n"
              "        p1 [label=\"trace\"];\n"
              "        p2 [label=\"resolve\"];\n"
              "    }\n"
              "    p0 -> p1 [label=\"depth, normal\"];\n"
              "    p1 -> p2 [label=\"rays\"];\n"
              "    p0 -> p3 [label=\"depth\"];\n"
              "    p2 -> p3 [label=\"rays\"];\n"
              "}\n");
}

TEST(PassListing, OfNothingIsEmpty) {
    EXPECT_EQ(passesAsMermaid({}), "flowchart TD\n");
    EXPECT_EQ(passesAsMarkdown({}).find("`"), std::string::npos);
}

}  // namespace
}  // namespace reflet::pass_listing_test
