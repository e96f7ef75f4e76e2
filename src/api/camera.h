// Converts a host's matrices, G-buffer and conventions to Reflet's.
#pragma once

#include "api/frame.h"
#include "lighting/host_images.h"

#include "reflet/reflet.h"

#include <functional>

namespace reflet::api {

/// Throws Failure for matrices that are no camera. size, before: sizes of this and the last frame.
ViewParams viewParams(const RefletFrameInfo& info, RefletDepthKind depthKind, uvec2 size, uvec2 before);

/// view: of viewParams.
ImportParams importParams(const RefletFrameInfo& info, const RefletGBuffer& g, const ViewParams& view);

/// Throws Failure for wrong images and kinds. read: the rectangle that the library reads of each image.
void checkGBuffer(const RefletGBuffer& g, const Rectangle& read);

/// adopt: makes an image of the host known to the recorder.
HostSurfaces hostSurfaces(const RefletGBuffer& g, const std::function<gpu::Image(const RefletImage&)>& adopt);

}  // namespace reflet::api
