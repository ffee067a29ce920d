#include "app/registry.h"
