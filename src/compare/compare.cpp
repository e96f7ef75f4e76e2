// How far a picture is from the truth.
#include "compare/compare.h"
