#pragma once

#include "task_group.h"
