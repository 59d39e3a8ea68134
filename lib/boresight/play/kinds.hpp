// The kinds of play there are. A new kind is one folder beside this file and one line here.
#pragma once

#include <type_traits>
#include <variant>

#include "boresight/play/ball/ball_in_socket.hpp"
#include "boresight/play/guide/slider_in_guide.hpp"
#include "boresight/play/journal/journal_in_sleeve.hpp"
#include "boresight/play/pad/pad_in_slot.hpp"
#include "boresight/play/pad/rectangular_pad_in_slot.hpp"

namespace boresight {

template <typename T, template <typename> typename Lanes, typename Own>
using PlayKind = std::conditional_t<std::is_same_v<T, double>, Own, Lanes<T>>;

template <typename T>
using PlayKinds = std::variant<                               //
    PlayKind<T, JournalInSleeveT, JournalInSleeve>,           // revolute, cylindrical, prismatic with a round guide
    PlayKind<T, BallInSocketT, BallInSocket>,                 // spherical
    PlayKind<T, PadInSlotT, PadInSlot>,                       // planar with a round pad
    PlayKind<T, SliderInGuideT, SliderInGuide>,               // prismatic with a rectangular guide
    PlayKind<T, RectangularPadInSlotT, RectangularPadInSlot>  // planar with a rectangular pad
    >;

}  // namespace boresight
