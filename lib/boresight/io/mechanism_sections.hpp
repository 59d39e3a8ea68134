// How `mechanism_file.cpp` divides its work: one function per kind of table. Internal to this room.
//
// Each takes the table's cursor, checks everything that this table alone and the tables before it can tell, and finishes it.
#pragma once

#include <vector>

#include "boresight/io/assumed_values.hpp"
#include "boresight/io/cursor.hpp"
#include "boresight/io/expression.hpp"
#include "boresight/mechanism/description.hpp"

namespace boresight {

// The tables of a file with all patterns copied out, in file order.
struct Sections {
  std::vector<Cursor> bodies, joints, clearances, springs, loads, errors;
};
Sections gather_sections(Cursor& root);

BodyDescription read_body(Cursor& cursor, const MechanismDescription& so_far);
// All but its name and boresight.
void read_mass_and_axes(Cursor& cursor, BodyDescription& body);
PayloadDescription read_payload(Cursor& cursor, const MechanismDescription& so_far);
JointDescription read_joint(Cursor& cursor, const MechanismDescription& so_far);
// Tables that stand for more than one bearing (expand_clearances.cpp) are replaced by one table a bearing; joints and bodies that this
// takes are added to the mechanism, whose joints have all been read.
std::vector<Cursor> expand_clearances(const std::vector<Cursor>& clearances, MechanismDescription& mechanism);
// assumed: what the table leaves out and results hang on is added; may be null.
ClearanceDescription read_clearance(Cursor& cursor, const MechanismDescription& so_far,
                                    std::vector<AssumedValue>* assumed);
SpringDescription read_spring(Cursor& cursor, const MechanismDescription& so_far);
LoadDescription read_load(Cursor& cursor, const MechanismDescription& so_far);
ErrorDescription read_error(Cursor& cursor, const MechanismDescription& so_far);
MotionDescription read_motion(Cursor& cursor, const MechanismDescription& so_far);
// Into `mechanism`: starting rates, and where journals start.
void read_initial(Cursor& cursor, MechanismDescription& mechanism);
LineOfSightDescription read_pointing(Cursor& cursor, const MechanismDescription& so_far);

// The name under `key`, checked to be usable in paths: not empty, none of . * = , { } or quotes, no control characters.
std::string read_name(Cursor& cursor, const std::string& key);
// The same with dots: "rod1.length".
std::string read_dotted_name(Cursor& cursor, const std::string& key);

// The index of the body or joint of this name; otherwise a fault at `key` with the nearest name.
int body_index(const MechanismDescription& mechanism, const Cursor& cursor, const std::string& key,
               const std::string& name, bool ground_allowed);
int joint_index(const MechanismDescription& mechanism, const Cursor& cursor, const std::string& key,
                const std::string& name);
// The key `journal` of a clearance: one of the joint's two bodies.
int read_journal(Cursor& cursor, const MechanismDescription& mechanism, const JointDescription& joint);
// connects = [FIRST, SECOND]: two different bodies, one of which may be the ground.
std::pair<int, int> read_connects(Cursor& cursor, const MechanismDescription& mechanism);

// An expression of t, finite with its derivatives over [0, duration].
TimeFunctionPtr read_expression(Cursor& cursor, const std::string& key, double duration,
                                const NamedExpressions& named = {}, double scale = 1.0);
// The same of a law that bodies follow, which must not jump, nor its rate: an impulse would be behind it.
TimeFunctionPtr read_motion_law(Cursor& cursor, const std::string& key, double duration,
                                const NamedExpressions& named = {}, double scale = 1.0);
TimeFunctionPtr compile_expression(const Cursor& cursor, const std::string& key, const std::string& text,
                                   double duration, const NamedExpressions& named = {}, double scale = 1.0);
// Of any function of time that a key stands for: that it is finite and within what is real, and that neither it nor its rate jumps.
void require_finite(const Cursor& cursor, const std::string& key, const std::string& text, const TimeFunction& function,
                    double duration);
void require_continuous(const Cursor& cursor, const std::string& key, const std::string& text,
                        const TimeFunction& function, double duration);

}  // namespace boresight
