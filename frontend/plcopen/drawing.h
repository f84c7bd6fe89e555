#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "frontend/iec/scope.h"
#include "frontend/plcopen/graph.h"
#include "frontend/plcopen/scan_order.h"
#include "frontend/semantics.h"

namespace rung::plcopen {

/// A body that is drawn, in scan order, and how to read it.
struct Drawing {
  Graph graph;
  std::vector<Network> networks;
  /// As PLCGenerator.py has it: `negated` wins over `storage` and `edge`, and
  /// means nothing at inVariables and outVariables.
  bool as_generator = false;
};

/// The drawing of a graph, checked. Errors: those of check_graph() and
/// scan_order(); RP094 for modifiers that mean nothing, or several things.
Drawing make_drawing(Graph graph, const Semantics& semantics,
                     ErrorLimit& errors);

/// What a modifier amounts to where `negated` wins.
Modifier effective(Modifier modifier, bool as_generator);

/// Executes a drawing once, in a scope: writes its statements.
///
/// For each network there are two passes. The first goes from the sinks along
/// the wires, in their order, and executes what has a state: edges, and blocks
/// that were not yet executed in this scan, the inputs before the block. The
/// second takes the values of contacts, as they are then. A part of a wire that
/// is used more than once is kept in a bit, so what is written is linear in
/// what is passed. In the generator's orders every sink passes its wires anew:
/// it sees what the sinks before it wrote, and has its own edges.
class DrawingRun {
 public:
  DrawingRun(const Drawing& drawing, iec::Scope& scope)
      : drawing_(&drawing), graph_(&drawing.graph), scope_(&scope) {}
  void run();

 private:
  using Index = std::uint32_t;

  /// One pass along wires: the edges in it are its own. Passes along the wires
  /// of a connector are made once, for all that continue it.
  struct Flow {
    std::unordered_set<Index> visited;
    std::unordered_map<std::uint64_t, iec::Value> edges;
  };
  /// Something to do in the first pass. Stacks of these replace recursion.
  struct Task {
    enum class Kind : std::uint8_t { Visit, Call, OutputEdge, InputEdge };
    Kind kind = Kind::Visit;
    Index element = 0;
    Index pin = 0;  // of a block: of an output for Visit and OutputEdge
    Index flow = 0;
    bool ordered = false;  // blocks further up are executed elsewhere
  };
  /// What gives a value in the second pass.
  struct Node {
    Index element = 0;
    Index output = 0;
    Index flow = 0;
    friend bool operator==(const Node&, const Node&) = default;
  };
  struct NodeHash {
    std::size_t operator()(const Node& node) const {
      return (std::uint64_t{node.element} << 32 ^ node.flow) *
                 0x9E3779B97F4A7C15ULL +
             node.output;
    }
  };
  struct Use {
    std::uint32_t count = 0;
    std::optional<iec::Value> value;
  };
  using Uses = std::unordered_map<Node, Use, NodeHash>;

  // The first pass.
  void run_network(const Network& network);
  void prepare(Index sink, Index flow);
  void push_inputs(Index element, Index flow, bool ordered);
  void push_wires(const Pin& pin, Index flow, bool ordered);
  void visit(const Task& task);
  void visit_block(const Task& task);
  void visit_contact(const Task& task);
  void visit_connector(Index connector, bool ordered);
  void output_edge(const Task& task);
  void input_edge(const Task& task);
  void call(Index block);
  void call_instance(const Element& block,
                     std::vector<iec::Argument> arguments);
  void call_function(Index index, std::vector<iec::Argument> arguments);
  std::optional<iec::Value> argument(Index block, Index pin);
  std::optional<iec::Value> edge(Edge edge, std::optional<iec::Value> clk,
                                 SourceRange where);
  Index new_flow();
  Index connector_flow(Index connector);

  // The second pass (drawing_values.cpp).
  std::optional<iec::Value> value_of(const Pin& pin, Index flow);
  Node resolve(const Wire& wire, Index flow);
  void collect(const Node& root, Uses& uses, std::vector<Node>& order);
  const std::vector<Wire>& wires_of(const Node& node) const;
  std::optional<iec::Value> take(const Node& node, Uses& uses);
  std::optional<iec::Value> compute(const Node& node, Uses& uses);
  std::optional<iec::Value> join(const std::vector<Wire>& wires, Index flow,
                                 Uses& uses, SourceRange where);
  std::optional<iec::Value> contact_value(const Element& contact);
  std::optional<iec::Value> output_value(Index element, Index output);
  std::optional<iec::Value> operand(const Text& text);
  std::optional<iec::Value> as_bit(std::optional<iec::Value> value,
                                   SourceRange where);

  // Sinks (drawing_sinks.cpp).
  void write(Index sink, iec::Value value);
  void write_coil(const Element& coil, iec::Value value);
  void write_variable(const Element& variable, iec::Value value);
  std::optional<iec::Value> enable_of(Index block);

  /// A value that stays as it is when variables are written.
  iec::Value kept(iec::Value value, SourceRange where);

  const Drawing* drawing_;
  const Graph* graph_;
  iec::Scope* scope_;
  std::vector<Task> tasks_;
  std::deque<Flow> flows_;
  std::unordered_set<Index> called_;
  std::unordered_map<Index, std::vector<Index>> pin_flows_;  // of a call
  std::unordered_map<Index, Index> connector_flows_;
  std::unordered_map<std::uint64_t, iec::Value> input_edges_;
  std::unordered_map<Index, iec::Value> results_;  // of functions
  std::unordered_map<Index, iec::Value> enables_;  // ENO of functions
  std::uint32_t edges_ = 0;  // the place of each in the body, in every run
};

}  // namespace rung::plcopen
