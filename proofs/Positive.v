(** * Theorem A: definite weights and the order 2k + 1 force C(k) on every block *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages Trees Methods Sums Check Pairs Products Conditions Weights.
Import ListNotations.
Open Scope Q_scope.

Section Bushes.
Variable M : method.
Variable c : nat -> V.
Hypothesis row_sums : nodes_are_row_sums M c.

Local Notation ψ := (psi (Pof M) (Aof M) (oneof M)).
Local Notation Ψ := (forest (Pof M) (Aof M) (oneof M)).
Local Notation admissible_under l us := (branches_admissible (sees M) (N M) l us).

(** j leaves of colour m. *)
Definition leaves m j := repeat (Node m []) j.
Lemma size_of_leaves m j : size (leaves m j) = j.
Proof. induction j; [reflexivity|]. change (S (size (leaves m j)) = S j). rewrite IHj.
reflexivity. Qed.

Lemma leaves_admissible l m j : (m < N M)%nat -> sees M l m -> admissible_under l (leaves m j).
Proof. intros Hm Hs. induction j; simpl; auto. Qed.

(** [τ^j] has the stage vector c^j, where the leaves are of the colour whose block gives the nodes.
*)
Lemma psi_of_leaves l m j : same M l (c l) (app (Aof M l m) (oneof M m)) ->
  veq (Ψ l (leaves m j)) (power_of M c l j).
Proof.
  intros H. induction j; [apply veq_refl|].
  change (Ψ l (leaves m (S j))) with
    (mul (Pof M l) (app (Aof M l m) (scale (number_of 1) (oneof M m))) (Ψ l (leaves m j))).
  apply mu_below; intros i Hi; [|apply IHj].
  rewrite (H i Hi). apply app_ext. intros x. unfold scale. change (number_of 1) with 1. ring.
Qed.

(** [τ^j], with leaves of that colour. *)
Lemma bush l j : (l < N M)%nat -> exists t, is_tree M t /\ root t = l /\ order t = S j /\
  veq (ψ t) (power_of M c l j).
Proof.
  intros Hl. destruct (row_sums l Hl) as [m [Hm [Hs Hc]]]. exists (Node l (leaves m j)).
  split; [split; [exact Hl|apply leaves_admissible; assumption]|].
  split; [reflexivity|]. split; [|apply psi_of_leaves, Hc].
  change (order (Node l (leaves m j))) with (S (size (leaves m j))). rewrite size_of_leaves.
  reflexivity.
Qed.

(** The branch [τ^{j−1}] across the block l, m. *)
Definition step l m j := app (Aof M l m) (scale (number_of j) (power_of M c m (j - 1))).

Variable p : nat.
Hypothesis has_p : has_order M p.

(** [τ^{i}, [τ^{j−1}], …, [τ^{j−1}]] with r such branches, in a method of that order. *)
Lemma comb l m i j r : (l < N M)%nat -> (m < N M)%nat -> sees M l m -> (1 <= j)%nat ->
  (S (i + r * j) <= p)%nat ->
  quadrature M l (Nat.iter r (mul (Pof M l) (step l m j)) (power_of M c l i))
    (inverse (S (i + r * j))).
Proof.
  intros Hl Hm Hs Hj Hp e He. destruct (bush m (j - 1) Hm) as [u [Hu [Rm [Ou Eu]]]].
  replace (S (j - 1)) with j in Ou by lia.
  destruct (row_sums l Hl) as [n [Hn [Hsn Hc]]].
  set (us := repeat u r ++ leaves n i).
  assert (Size : size us = (i + r * j)%nat).
  { unfold us. clear - Ou. induction r; simpl; [rewrite size_of_leaves; lia|].
    change ((order u + size (repeat u r ++ leaves n i))%nat = (i + (j + r * j))%nat). lia. }
  assert (Adm : admissible_under l us).
  { unfold us. clear - Rm Hu Hs Hn Hsn. induction r; simpl; [apply leaves_admissible; assumption|].
    rewrite Rm. auto. }
  assert (Psi : veq (Ψ l us) (Nat.iter r (mul (Pof M l) (step l m j)) (power_of M c l i))).
  { unfold us. clear - Rm Ou Eu Hc. induction r; simpl; [apply psi_of_leaves, Hc|].
    apply mu_ext; [|apply IHr]. rewrite Rm, Ou. apply app_ext. intros x. unfold scale.
    rewrite (Eu x).
    reflexivity. }
  rewrite <- (b_ext M l e _ _ Psi).
  rewrite <- Size in Hp |- *. exact (has_p (Node l us) Hp (conj Hl Adm) e He).
Qed.

Lemma B_of_order : every_colour M (fun l => B M c l p).
Proof.
  intros l Hl j Hj e He. destruct (bush l (j - 1) Hl) as [t [Ht [R [O E]]]].
  rewrite <- (b_ext M l e _ _ E). replace j with (order t) by lia. rewrite <- R.
  apply (has_p t ltac:(lia) Ht e He).
Qed.

Lemma even_of_order k : (2 * k + 2 <= p)%nat -> every_block M (fun l m => even M c l m k).
Proof.
  intros Hp l m Hl Hm Hs e He.
  pose proof (comb l m k (S k) 1 Hl Hm Hs ltac:(lia) ltac:(lia) e He) as K. simpl Nat.iter in K.
  assert (E : veq (mul (Pof M l) (step l m (S k)) (power_of M c l k))
    (scale (number_of (S k)) (mul (Pof M l) (power_of M c l k) (app (Aof M l m)
      (power_of M c m k))))).
  { eapply veq_trans; [apply mu_comm|].
    eapply veq_trans; [|apply mu_scale]. apply mu_ext; [apply veq_refl|].
    unfold step. replace (S k - 1)%nat with k by lia. apply app_scale. }
  rewrite (b_ext M l e _ _ E), b_scale in K.
  pose proof (number_of_not_0 (S k) ltac:(lia)) as Z.
  apply Qmult_inj_l with (1 := Z). rewrite K. unfold rational. destruct (Nat.eqb e 0); [|ring].
  rewrite !number_of_inverse by lia. replace (S (k + 1 * S k)) with (2 * S k)%nat by lia.
  rewrite !number_of_times. change (number_of 2) with 2. field. exact Z.
Qed.
End Bushes.

Theorem theorem_A M c k : definite M -> nodes_are_row_sums M c -> has_order M (2 * k + 1) ->
  every_block M (fun l m => C M c l m k).
Proof.
  intros Def Rows Order l m Hl Hm Hs j Hj.
  set (w := step M c l m j). set (x := power_of M c l j).
  (* the trees [[τ^{j−1}], [τ^{j−1}]], [τ^j, [τ^{j−1}]] and [τ^{2j}] *)
  pose proof (comb M c Rows _ Order l m 0 j 2 Hl Hm Hs ltac:(lia) ltac:(lia)) as T2.
  pose proof (comb M c Rows _ Order l m j j 1 Hl Hm Hs ltac:(lia) ltac:(lia)) as T1.
  pose proof (comb M c Rows _ Order l m (2 * j) j 0 Hl Hm Hs ltac:(lia) ltac:(lia)) as T0.
  replace (S (0 + 2 * j)) with (S (2 * j)) in T2 by lia.
  replace (S (j + 1 * j)) with (S (2 * j)) in T1 by lia.
  replace (S (2 * j + 0 * j)) with (S (2 * j)) in T0 by lia.
  simpl Nat.iter in *. fold w in T2, T1. fold x in T1.
  set (v := add w (scale (-(1)) x)).
  assert (Zero : same M l v (fun _ => 0)).
  { apply (Def l Hl). intros e He.
    specialize (T2 e He). specialize (T1 e He). specialize (T0 e He).
    assert (Sq : b M l e (mul (Pof M l) v v) ==
        b M l e (mul (Pof M l) w w) - 2 * b M l e (mul (Pof M l) w x) + b M l e (mul (Pof M l)
          x x)).
    { pose proof (mul_left (b M l e) (Pof M l)) as Left.
    pose proof (mul_right (b M l e) (Pof M l)) as Right.
      unfold v. rewrite (l_add _ (Left _ (b_linear M l e))), (l_scale _ (Left _ (b_linear M l e))).
      rewrite !(l_add _ (Right _ (b_linear M l e))), !(l_scale _ (Right _ (b_linear M l e))).
      rewrite (b_ext M l e _ _ (mu_comm M l x w)). ring. }
    assert (E2 : b M l e (mul (Pof M l) w w) == rational (inverse (S (2 * j))) e).
    { rewrite <- T2. apply b_ext, mu_below; [intros; reflexivity|]. intros i Hi. symmetry.
    apply mu_one, Hi. }
    assert (E0 : b M l e (mul (Pof M l) x x) == rational (inverse (S (2 * j))) e).
    { rewrite <- T0. apply b_ext. replace (j + (j + 0))%nat with (j + j)%nat by lia.
    apply power_plus_power. }
    rewrite Sq, E2, T1, E0. unfold rational. destruct (Nat.eqb e 0); ring. }
  intros i Hi. specialize (Zero i Hi). unfold v, add, scale, w, step in Zero.
  rewrite (app_scale (Aof M l m) _ _ i) in Zero. unfold scale in *.
  rewrite number_of_inverse by lia. fold x.
  pose proof (number_of_not_0 j ltac:(lia)) as Z. apply Qmult_inj_l with (1 := Z).
  setoid_replace (number_of j * (/ number_of j * x i)) with (x i) by (field; exact Z).
  rewrite <- (Qplus_0_l (x i)), <- Zero. ring.
Qed.

(** In a method with stages at points. *)
Corollary theorem_A_with_positive_weights M c k positive : at_points M -> ordering M positive ->
  positive_weights M positive -> nodes_are_row_sums M c -> has_order M (2 * k + 1) ->
  every_block M (fun l m => C M c l m k).
Proof. intros P O W. apply theorem_A, positive_is_definite with positive; assumption. Qed.
Print Assumptions theorem_A_with_positive_weights.
