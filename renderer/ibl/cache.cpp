#include "renderer/ibl/cache.h"
