// Subpixel jitter, for callers of the temporal stage.
#pragma once

#include "effects/jitter.h"
