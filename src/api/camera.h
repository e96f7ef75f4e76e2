// A host's matrices and conventions as Reflet's.
#pragma once

#include "lighting/host_images.h"

#include "reflet/reflet.h"

#include <functional>

namespace reflet::api {

/// Throws Failure for matrices that are no camera. size, before: of this and the last frame.
ViewParams viewParams(const RefletFrameInfo& info, RefletDepthKind depthKind, uvec2 size, uvec2 before);

/// view: of viewParams.
ImportParams importParams(const RefletFrameInfo& info, const RefletGBuffer& g, const ViewParams& view);

/// adopt: makes an image of the host known to the recorder.
HostSurfaces hostSurfaces(const RefletGBuffer& g, const std::function<gpu::Image(const RefletImage&)>& adopt);

}  // namespace reflet::api
