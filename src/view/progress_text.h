// How far the picture is, in a few words.
#pragma once

#include "view/render_thread.h"

#include <string>

namespace reflet {

/// "compiling 40 shaders", "frame 3 of 32", "finished", … job: that the thread is busy with; empty: none.
std::string progressText(const RenderThread::State& published, Running running, const std::string& job);

}  // namespace reflet
