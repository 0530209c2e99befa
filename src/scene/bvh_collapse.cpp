#include "scene/bvh_collapse.hpp"

#include "scene/bvh_cut.hpp"
#include "scene/error.hpp"
#include "scene/parallel.hpp"

namespace lanecast {
namespace {

constexpr std::uint32_t task_size = 8192; ///< subtrees of fewer primitives are pieces
constexpr std::uint32_t no_piece = 0xffffffffu;

/// Where a piece's root stands in the piece above.
struct Above {
    std::uint32_t piece, child;
};

class Collapse {
public:
    Collapse(const BinaryTree& tree, const std::uint32_t* cuts, const BuildRef* refs)
        : nodes_(tree.nodes.get()), cuts_(cuts), refs_(refs) {}

    WideTree run(int threads) {
        place_top(0, {no_piece, 0});
        parallel_for(threads, tree_.pieces.size(), [&](std::size_t i) {
            WidePiece& piece = tree_.pieces[i];
            if (piece.nodes.empty()) place(piece, piece.root);
        });
        join();
        return std::move(tree_);
    }

private:
    /// The nodes of large subtrees are pieces of their own, between those of their children.
    void place_top(std::uint32_t root, Above above) {
        const auto index = static_cast<std::uint32_t>(tree_.pieces.size());
        above_.push_back(above);
        WidePiece& piece = tree_.pieces.emplace_back();
        piece.root = root;
        if (nodes_[root].count < task_size) return;
        add_node(piece, root);
        const WideNode wide = piece.nodes[0];
        for (std::uint32_t i = 0; i < wide.count; ++i)
            if ((wide.leaves >> i & 1u) == 0) place_top(wide.child[i], {index, i});
    }

    /// A subtree, depth first. Returns the offset.
    std::uint32_t place(WidePiece& piece, std::uint32_t root) const {
        const std::size_t index = piece.nodes.size();
        add_node(piece, root);
        const std::uint32_t count = piece.nodes[index].count, leaves = piece.nodes[index].leaves;
        for (std::uint32_t i = 0; i < count; ++i)
            if ((leaves >> i & 1u) == 0) {
                const std::uint32_t offset = place(piece, piece.nodes[index].child[i]);
                piece.nodes[index].place[i] = offset;
            }
        return piece.nodes[index].offset;
    }

    /// The node and its leaves.
    void add_node(WidePiece& piece, std::uint32_t root) const {
        WideNode wide{};
        wide.offset = piece.size.units;
        piece.size.units += sizeof(BvhNode) / 64;
        piece.size.nodes += 1;
        if (is_leaf(cuts_[root])) // a single leaf is the only child of its node
            wide.child[wide.count++] = root, wide.leaves = 1;
        else
            add_halves(wide, root, left_children(cuts_[root]), child_count(cuts_[root]));
        for (std::uint32_t i = 0; i < wide.count; ++i)
            if ((wide.leaves >> i & 1u) != 0) add_leaf(piece, wide, i);
        piece.nodes.push_back(wide);
    }

    void add_children(WideNode& wide, std::uint32_t root, std::uint32_t places) const {
        const std::uint32_t left = places > 1 ? left_places(cuts_[root], places) : 0;
        if (left == 0) {
            wide.leaves |= (is_leaf(cuts_[root]) ? 1u : 0u) << wide.count;
            wide.child[wide.count++] = root;
            return;
        }
        add_halves(wide, root, left, places);
    }

    void add_halves(WideNode& wide, std::uint32_t root, std::uint32_t left, std::uint32_t places) const {
        add_children(wide, nodes_[root].children, left);
        add_children(wide, nodes_[root].children + 1, places - left);
    }

    void add_leaf(WidePiece& piece, WideNode& wide, std::uint32_t i) const {
        const BinaryNode& leaf = nodes_[wide.child[i]];
        const std::uint32_t kind = kind_of(refs_[leaf.first]);
        wide.kinds |= kind << (4 * i);
        wide.reference[i] = piece.size.references[kind];
        piece.size.references[kind] += leaf.count;
        wide.leaf[i] = piece.size.leaves++;
        if (kind != static_cast<std::uint32_t>(PrimitiveKind::triangle)) return;
        wide.place[i] = piece.size.units;
        piece.size.units += block_units(leaf.count);
    }

    /// Puts the pieces behind each other.
    void join() {
        std::uint64_t units = 0;
        for (std::size_t p = 0; p < tree_.pieces.size(); ++p) {
            WidePiece& piece = tree_.pieces[p];
            piece.begin = tree_.size;
            units += piece.size.units;
            if (units * 64 > largest_arena) throw Error(ExitCode::memory, "the tree would exceed 2 GiB");
            tree_.size.units += piece.size.units;
            tree_.size.nodes += piece.size.nodes;
            tree_.size.leaves += piece.size.leaves;
            for (int kind = 0; kind < primitive_kind_count; ++kind) tree_.size.references[kind] += piece.size.references[kind];
            if (const Above above = above_[p]; above.piece != no_piece) {
                WidePiece& parent = tree_.pieces[above.piece]; // comes first, so its begin is known
                parent.nodes[0].place[above.child] = piece.begin.units - parent.begin.units;
            }
        }
    }

    const BinaryNode* nodes_;
    const std::uint32_t* cuts_;
    const BuildRef* refs_;
    WideTree tree_;
    std::vector<Above> above_; ///< of each piece
};

} // namespace

WideTree collapse(const BinaryTree& tree, const BuildRef* refs, bool join_leaves, int threads) {
    const Cuts cuts = find_cuts(tree, refs, join_leaves, threads);
    return Collapse(tree, cuts.get(), refs).run(threads);
}

} // namespace lanecast
