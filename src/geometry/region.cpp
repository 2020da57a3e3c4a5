#include "geometry/region.hpp"
