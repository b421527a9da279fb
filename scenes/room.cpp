#include "scenes/room.h"
