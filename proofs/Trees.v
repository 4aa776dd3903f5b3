(** * N-trees, their stage vectors and the order conditions *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages.
Import ListNotations.
Open Scope Q_scope.

(** A vertex with a colour, and its branches. Branches are in a list: every N-tree is one of these,
    whatever the order of its branches. *)
Inductive tree := Node : nat -> list tree -> tree.

Definition root t := match t with Node l _ => l end.

(** ρ(u), the number of vertices. *)
Fixpoint order t : nat :=
  match t with Node _ branches =>
    S ((fix size us := match us with [] => O | u :: r => (order u + size r)%nat end) branches)
  end.
Definition size :=
  fix size us := match us with [] => O | u :: r => (order u + size r)%nat end.

(** ** A method: a product on the stages of each colour, the blocks, 𝟙 *)

Section Method.
Variable mulof : nat -> product.        (* colour l: the product ⊙ on its stage values *)
Variable A : nat -> nat -> matrix.      (* A^{l,m}, from stage values of m to those of l *)
Variable one : nat -> V.                (* 𝟙 of colour l *)
Variable sees : nat -> nat -> Prop.     (* whether there is a block l, m *)

(** ψ(u) = ⊙ A^{l,m} (ρ(u_i) ψ(u_i)) over the branches u_i, with m the colour of the root of u_i:
    the elementary weight of the stages times γ(u)/ρ(u). *)
Fixpoint psi t : V :=
  match t with Node l branches =>
    (fix product us := match us with
       | [] => one l
       | u :: r => mul (mulof l) (app (A l (root u)) (scale (inject_Z (Z.of_nat (order u))) (psi
         u)))
                       (product r)
     end) branches
  end.
Definition forest l :=
  fix product us := match us with
    | [] => one l
    | u :: r => mul (mulof l) (app (A l (root u)) (scale (inject_Z (Z.of_nat (order u))) (psi u)))
                    (product r)
  end.

Variable N : nat.

(** Colours are below N, and a vertex sees the colours of its branches. *)
Fixpoint admissible t : Prop :=
  match t with Node l branches =>
    (l < N)%nat /\
    (fix all us := match us with
       | [] => True | u :: r => sees l (root u) /\ admissible u /\ all r end) branches
  end.
Definition branches_admissible l :=
  fix all us := match us with
    | [] => True | u :: r => sees l (root u) /\ admissible u /\ all r end.

Lemma order_pos t : (1 <= order t)%nat.
Proof. destruct t; simpl; lia. Qed.

(** ** Soundness of the certificate

    F k l stands for the trees with a root of colour l and k more vertices, G j l for what branches
    of order j contribute at a vertex of colour l. If the hulls of these points and directions are
    closed under the recursion for ψ, ψ of every tree up to order p is in one of them. *)

Variable p : nat.
Variable F G : nat -> nat -> list (V * Q).

Hypothesis starts : forall l, (l < N)%nat -> hull (F 0 l) 1 (one l).
Hypothesis branches : forall j l m, (S j < p)%nat -> (l < N)%nat -> (m < N)%nat -> sees l m ->
  forall a, In a (F j m) ->
    hull (G (S j) l) (snd a) (app (A l m) (scale (inject_Z (Z.of_nat (S j))) (fst a))).
Hypothesis products : forall k l j, (k < p)%nat -> (l < N)%nat -> (1 <= j <= k)%nat ->
  forall u w, In u (G j l) -> In w (F (k - j) l) ->
    hull (F k l) (snd u * snd w) (mul (mulof l) (fst u) (fst w)).

Lemma spanned n : forall l us, (size us < n)%nat -> (size us < p)%nat -> (l < N)%nat ->
  branches_admissible l us -> hull (F (size us) l) 1 (forest l us).
Proof.
  induction n; [lia|]. intros l us Hn Hp Hl Hok. destruct us as [|u r]; [apply starts, Hl|].
  destruct Hok as [Hs [Hu Hr]]. destruct u as [m vs]. simpl in Hs. destruct Hu as [Hm Hvs].
  set (k := size (Node m vs :: r)) in *.
  assert (Ek : k = (S (size vs) + size r)%nat) by reflexivity.
  change (hull (F k l) (1 * 1) (mul (mulof l)
    (app (A l m) (scale (inject_Z (Z.of_nat (S (size vs)))) (forest m vs))) (forest l r))).
  apply hull_mul with (S1 := G (S (size vs)) l) (S2 := F (k - S (size vs)) l).
  - intros a w Ha Hw. apply products with (j := S (size vs)); try assumption; lia.
  - apply hull_map with (S := F (size vs) m).
    + intros a Ha. apply (branches (size vs) l m); try assumption; lia.
    + apply IHn; try assumption; lia.
  - replace (k - S (size vs))%nat with (size r) by lia. apply IHn; try assumption; lia.
Qed.

Theorem trees_are_spanned t : (order t <= p)%nat -> admissible t ->
  hull (F (order t - 1) (root t)) 1 (psi t).
Proof.
  destruct t as [l us]. intros Ho [Hl Hus]. change (order (Node l us)) with (S (size us)) in *.
  replace (S (size us) - 1)%nat with (size us) by lia.
  apply (spanned (S (size us))); try assumption; lia.
Qed.
End Method.

Lemma colour_below sees N t : admissible sees N t -> (root t < N)%nat.
Proof. destruct t. simpl. intros [H _]. exact H. Qed.
