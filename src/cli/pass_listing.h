// Shows the passes of a frame: as tables, or as a diagram of what they hand to each other.
#pragma once

#include "gpu/listing.h"

#include <string>

namespace reflet {

/// Two tables: of passes; of resources with their lifetimes.
std::string passesAsMarkdown(const gpu::PassListing& listing);

/// A flow chart of the frame's steps, to be read: passes of one scope ("diffuse.", or "planar0." and "planar1.") are one
/// box. An arrow is what a step reads of another, by the last pass before that has written it; at most three
/// names, from what was written last.
std::string passesAsMermaid(const gpu::PassListing& listing);

/// All passes, for Graphviz: those of one scope are a group, and an arrow has all names.
std::string passesAsDot(const gpu::PassListing& listing);

}  // namespace reflet
