#include "renderer/core/image.h"
