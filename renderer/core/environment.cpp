#include "renderer/core/environment.h"
