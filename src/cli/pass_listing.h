// Shows the passes of a frame: as tables, or as a diagram of what they hand to each other.
#pragma once

#include "gpu/listing.h"

#include <string>

namespace reflet {

/// Two tables: of passes; of resources with their lifetimes.
std::string passesAsMarkdown(const gpu::PassListing& listing);

/// A flow chart from left to right. Passes of one scope ("diffuse.") are a group; an arrow is a resource that a pass
/// reads, from the last pass before it that has written it.
std::string passesAsMermaid(const gpu::PassListing& listing);

/// The same for Graphviz.
std::string passesAsDot(const gpu::PassListing& listing);

}  // namespace reflet
