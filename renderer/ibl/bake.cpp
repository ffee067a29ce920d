#include "renderer/ibl/bake.h"
