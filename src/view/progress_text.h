// Progress of the picture as a short text.
#pragma once

#include "view/render_thread.h"

#include <string>

namespace reflet {

/// "compiling 40 shaders", "frame 3 of 32", "finished", … job: current job of the render thread; empty: none.
std::string progressText(const RenderThread::State& published, Running running, const std::string& job);

}  // namespace reflet
