(** * The checker, which computes with whole numbers, and why what it accepts is true *)

From Coq Require Import QArith ZArith List Arith Lia Bool.
From Gark Require Import Stages Trees Methods Tables.
Import ListNotations.
Open Scope Q_scope.

(** ** Vectors and coefficients with one denominator *)

Definition zvec := (list Z * positive)%type.
Definition val (x : zvec) : V := fun i => nth i (fst x) 0%Z # snd x.

Fixpoint zlin (ts : list (nat * Z)) (x : list Z) : Z :=
  match ts with [] => 0%Z | (j, q) :: r => (q * nth j x 0 + zlin r x)%Z end.
Fixpoint zbil (ts : list (nat * nat * Z)) (x y : list Z) : Z :=
  match ts with [] => 0%Z | (a, c, q) :: r => (q * nth a x 0 * nth c y 0 + zbil r x y)%Z end.

Definition common (qs : list Q) : positive :=
  fold_right (fun q d => Z.to_pos (Z.lcm (Zpos (Qden q)) (Zpos d))) 1%positive qs.
Definition whole (D : positive) (q : Q) : Z := (Qnum q * (Zpos D / Zpos (Qden q)))%Z.
Definition scaled {X} D (ts : list (X * Q)) : list (X * Z) :=
  map (fun t => (fst t, whole D (snd t))) ts.

Lemma common_divides qs q : In q qs -> (Zpos (Qden q) | Zpos (common qs))%Z.
Proof.
  assert (P : forall a b, Zpos (Z.to_pos (Z.lcm (Zpos a) (Zpos b))) = Z.lcm (Zpos a) (Zpos b)).
  { intros a b. apply Z2Pos.id. pose proof (Z.lcm_nonneg (Zpos a) (Zpos b)).
    assert (Z.lcm (Zpos a) (Zpos b) <> 0)%Z by (rewrite Z.lcm_eq_0; lia). lia. }
  induction qs as [|r qs IH]; [contradiction|]. cbn [common fold_right]. fold (common qs).
  rewrite P.
  intros [->|I]; [apply Z.divide_lcm_l|].
  apply Z.divide_trans with (1 := IH I), Z.divide_lcm_r.
Qed.
Lemma whole_is D q : (Zpos (Qden q) | Zpos D)%Z -> q == whole D q # D.
Proof.
  intros [k E]. unfold whole, Qeq. simpl Qnum. simpl Qden. rewrite E, Z.div_mul by discriminate.
  ring.
Qed.
Definition is_scaled {X} D (ts : list (X * Q)) := forall t, In t ts -> snd t == whole D (snd t) # D.

Lemma same_denominator a b d : (a # d) + (b # d) == (a + b)%Z # d.
Proof. unfold Qeq, Qplus; simpl. rewrite Pos2Z.inj_mul. ring. Qed.

Lemma zlin_val D ts x : is_scaled D ts ->
  lin ts (val x) == zlin (scaled D ts) (fst x) # (D * snd x).
Proof.
  induction ts as [|[j q] r IH]; simpl; intros H; [reflexivity|].
  rewrite IH, <- same_denominator by (intros t K; apply H; right; exact K).
  pose proof (H _ (or_introl eq_refl)) as E. simpl in E. rewrite E at 1. reflexivity.
Qed.

Lemma zbil_val D ts x y : is_scaled D ts ->
  bil ts (val x) (val y) == zbil (scaled D ts) (fst x) (fst y) # (D * snd x * snd y).
Proof.
  induction ts as [|[[a c] q] r IH]; simpl; intros H; [reflexivity|].
  rewrite IH, <- same_denominator by (intros t K; apply H; right; exact K).
  pose proof (H _ (or_introl eq_refl)) as E. simpl in E. rewrite E at 1. reflexivity.
Qed.

(** A matrix or a product, row after row. *)
Definition ztable X := (positive * list (list (X * Z)))%type.
Definition zt {X} (rs : list (list (X * Q))) : ztable X :=
  let D := common (map snd (concat rs)) in (D, map (scaled D) rs).

Definition zapp (A : ztable nat) (x : zvec) : zvec :=
  (map (fun ts => zlin ts (fst x)) (snd A), fst A * snd x)%positive.
Definition zmul (P : ztable (nat * nat)) (x y : zvec) : zvec :=
  (map (fun ts => zbil ts (fst x) (fst y)) (snd P), fst P * snd x * snd y)%positive.
Definition zscale (n : nat) (x : zvec) : zvec :=
  (map (Z.mul (Z.of_nat n)) (fst x), snd x).

Lemma row_is_scaled {X} (rs : list (list (X * Q))) i : is_scaled (fst (zt rs)) (nth i rs []).
Proof.
  intros t I. apply whole_is, common_divides, in_map, in_concat. exists (nth i rs []).
  split; [|exact I]. destruct (nth_in_or_default i rs []) as [K|K]; [exact K|].
  rewrite K in I. contradiction.
Qed.

Lemma zapp_val rs x : veq (val (zapp (zt rs) x)) (app (fun i => nth i rs []) (val x)).
Proof.
  intros i. unfold val at 1, app. simpl fst. simpl snd.
  rewrite (zlin_val (fst (zt rs)) _ x (row_is_scaled rs i)). simpl fst.
  rewrite map_map. change 0%Z with ((fun ts => zlin (scaled (common (map snd (concat rs))) ts)
    (fst x)) []).
  rewrite map_nth. reflexivity.
Qed.

Lemma zmul_val rs x y : veq (val (zmul (zt rs) x y)) (mul (fun i => nth i rs []) (val x) (val y)).
Proof.
  intros i. unfold val at 1, mul. simpl fst. simpl snd.
  rewrite (zbil_val (fst (zt rs)) _ x y (row_is_scaled rs i)). simpl fst.
  rewrite map_map.
  change 0%Z with ((fun ts => zbil (scaled (common (map snd (concat rs))) ts) (fst x) (fst y)) []).
  rewrite map_nth. reflexivity.
Qed.

Lemma zscale_val n x : veq (val (zscale n x)) (scale (inject_Z (Z.of_nat n)) (val x)).
Proof.
  intros i. unfold val, scale, zscale. simpl fst. simpl snd.
  replace (nth i (map (Z.mul (Z.of_nat n)) (fst x)) 0%Z) with (Z.of_nat n * nth i (fst x) 0)%Z.
  - unfold Qeq; simpl. reflexivity.
  - rewrite <- map_nth with (f := Z.mul (Z.of_nat n)). rewrite Z.mul_0_r. reflexivity.
Qed.

(** ** Affine hulls: a point, and directions, each with an entry by whose value it is taken *)

Record zhull := { den : positive; base : list Z; dirs : list (nat * list Z) }.

Fixpoint zadd (xs ys : list Z) : list Z :=
  match xs, ys with
  | [], _ => ys
  | _, [] => xs
  | x :: xs, y :: ys => (x + y)%Z :: zadd xs ys
  end.

Lemma nth_zadd i : forall xs ys, nth i (zadd xs ys) 0%Z = (nth i xs 0 + nth i ys 0)%Z.
Proof.
  induction i; intros [|x xs] [|y ys]; simpl; rewrite ?Z.add_0_r; try reflexivity. apply IHi.
Qed.

Definition zpoints_of (H : zhull) : list zvec :=
  (base H, den H) :: map (fun r => (zadd (base H) (snd r), den H)) (dirs H).
Definition zpoints (H : option zhull) := match H with None => [] | Some H => zpoints_of H end.
Definition points H := map val (zpoints H).

Fixpoint zcomb (v : list Z) (rs : list (nat * list Z)) (i : nat) : Z :=
  match rs with [] => 0%Z | (pivot, r) :: rs => (nth pivot v 0 * nth i r 0 + zcomb v rs i)%Z end.

Definition longest (H : zhull) (v : zvec) : nat :=
  fold_right Nat.max (Nat.max (length (fst v)) (length (base H)))
    (map (fun r => length (snd r)) (dirs H)).

Definition is_in (H : zhull) (v : zvec) : bool :=
  forallb (fun i => Z.eqb (nth i (fst v) 0 * Zpos (den H))%Z
                          (nth i (base H) 0 * Zpos (snd v) + zcomb (fst v) (dirs H) i)%Z)
    (seq 0 (longest H v)).
Definition in_zhull (H : option zhull) v := match H with None => false | Some H => is_in H v end.

Fixpoint comb d (v : V) (rs : list (nat * list Z)) : V :=
  match rs with
  | [] => fun _ => 0
  | (pivot, r) :: rs => add (scale (v pivot) (val (r, d))) (comb d v rs)
  end.

Lemma comb_val d v rs i :
  comb d (val v) rs i == zcomb (fst v) rs i # (snd v * d).
Proof.
  induction rs as [|[pivot r] rs IH]; simpl; [reflexivity|].
  unfold add, scale. rewrite IH, <- same_denominator. reflexivity.
Qed.

Lemma max_le n : forall ns m, (fold_right Nat.max m ns <= n)%nat ->
  (m <= n)%nat /\ forall k, In k ns -> (k <= n)%nat.
Proof.
  induction ns as [|a ns IH]; simpl; intros m H; [split; [assumption|contradiction]|].
  destruct (IH m ltac:(lia)) as [I J]. split; [assumption|].
  intros k [->|K]; [lia|apply J, K].
Qed.

Lemma is_in_all H v : is_in H v = true -> forall i,
  (nth i (fst v) 0 * Zpos (den H) = nth i (base H) 0 * Zpos (snd v) + zcomb (fst v) (dirs H) i)%Z.
Proof.
  intros K i. unfold is_in in K. rewrite forallb_forall in K.
  destruct (lt_dec i (longest H v)) as [L|L].
  - apply Z.eqb_eq, K, in_seq. lia.
  - unfold longest in L. apply Nat.nlt_ge, max_le in L. destruct L as [L J].
    rewrite (nth_overflow (fst v)), (nth_overflow (base H)) by lia.
    assert (E : zcomb (fst v) (dirs H) i = 0%Z).
    { clear K L. induction (dirs H) as [|[pivot r] rs IH]; simpl; [reflexivity|].
      rewrite IH; [|intros k Hk; apply J; right; assumption].
      rewrite (nth_overflow r); [ring|]. apply J. left. reflexivity. }
    rewrite E. ring.
Qed.

Lemma comb_zero f c d b rs v : linear f -> f (val (b, d)) == c ->
  (forall r, In r rs -> f (val (zadd b (snd r), d)) == c) -> f (comb d v rs) == 0.
Proof.
  intros L B. induction rs as [|[pivot r] rs IH]; simpl; intros K.
  - rewrite (l_ext _ L _ (scale 0 (fun _ => 0))); [rewrite (l_scale _ L); ring|].
    intros i. unfold scale. ring.
  - rewrite (l_add _ L), (l_scale _ L), IH; [|intros; apply K; right; assumption].
    assert (E : f (val (r, d)) == 0).
    { assert (S : f (val (zadd b r, d)) == f (val (b, d)) + f (val (r, d))).
      { rewrite <- (l_add _ L). apply (l_ext _ L). intros i. unfold add, val; simpl.
        rewrite nth_zadd, same_denominator. reflexivity. }
      rewrite (K (pivot, r) (or_introl eq_refl)), B in S. 
      setoid_replace (f (val (r, d))) with (c + f (val (r, d)) - c) by ring.
      rewrite <- S. ring. }
    rewrite E. ring.
Qed.

Lemma in_zhull_hull H v : in_zhull H v = true -> hull (points H) (val v).
Proof.
  destruct H as [H|]; [simpl|discriminate].
  intros K f c L G. assert (I := is_in_all H v K).
  assert (B : f (val (base H, den H)) == c) by (apply G; left; reflexivity).
  assert (D : forall r, In r (dirs H) -> f (val (zadd (base H) (snd r), den H)) == c).
  { intros r R. apply G. right. apply in_map, in_map_iff. exists r.
  split; [reflexivity|assumption]. }
  rewrite (l_ext _ L _ (add (val (base H, den H)) (comb (den H) (val v) (dirs H)))).
  - rewrite (l_add _ L), B, (comb_zero f c _ _ _ _ L B D). ring.
  - intros i. unfold add. rewrite comb_val. unfold val; simpl.
    unfold Qeq, Qplus; simpl. specialize (I i).
    rewrite !Pos2Z.inj_mul. 
    transitivity ((nth i (fst v) 0 * Zpos (den H)) * Zpos (snd v) * Zpos (den H))%Z; [ring|].
    rewrite I. ring.
Qed.

Lemma hull_ext S v w : veq v w -> hull S v -> hull S w.
Proof. intros E H f c L K. rewrite <- (l_ext _ L v w E). apply H; assumption. Qed.

(** ** The checker *)

Section Checker.
Variable M : method.
Variable p : nat.
Variable F G : list (list (option zhull)).
(* F by k = 0, …, p − 1, G by the order of a branch, both by the colour; None where no tree is *)

Definition Fof k l := nth l (nth k F []) None.
Definition Gof j l := nth l (nth j G []) None.
Definition all (n : nat) (c : nat -> bool) := forallb c (seq 0 n).
Definition table {X} (n : nat) (f : nat -> X) : list X := map f (seq 0 n).

Definition is_seen l m := match block M (space_of M l) m with None => false | _ => true end.
Definition A_rows l m :=
  match block M (space_of M l) m with None => [] | Some A => block_table M A end.
Definition P_rows l := product_table M (the_space M (space_of M l)).
Definition W_rows l := row_table M (snd (nth l (colours M) (O, []))).

Definition zone l : zvec := (map Qnum (one_of M (the_space M (space_of M l))), 1%positive).

(** Products, blocks and weights, made once. *)
Record ztables := {
  zP : list (ztable (nat * nat)); zA : list (list (ztable nat)); zW : list (ztable nat) }.
Definition the_tables : ztables := {|
  zP := table (N M) (fun l => zt (P_rows l));
  zA := table (N M) (fun l => table (N M) (fun m => zt (A_rows l m)));
  zW := table (N M) (fun l => zt (W_rows l)) |}.

Section WithTables.
Variable T : ztables.
Definition Pz l := nth l (zP T) (1%positive, []).
Definition Az l m := nth m (nth l (zA T) []) (1%positive, []).
Definition Wz l := nth l (zW T) (1%positive, []).

Definition starts_ok := all (N M) (fun l => in_zhull (Fof 0 l) (zone l)).

Definition branches_ok :=
  all (p - 1) (fun j => all (N M) (fun l => all (N M) (fun m =>
    negb (is_seen l m) ||
    forallb (fun a => in_zhull (Gof (S j) l) (zapp (Az l m) (zscale (S j) a)))
      (zpoints (Fof j m))))).

Definition products_ok :=
  all p (fun k => all (N M) (fun l => all k (fun i =>
    forallb (fun u => forallb (fun w => in_zhull (Fof k l) (zmul (Pz l) u w))
      (zpoints (Fof (k - S i) l))) (zpoints (Gof (S i) l))))).

(** b_l(v) = 1/(k + 1). *)
Definition meets l k (v : zvec) : bool :=
  let x := zapp (Wz l) v in
  all (degree M) (fun e =>
    Qeq_bool (nth e (fst x) 0%Z # snd x) (if Nat.eqb e 0 then 1 # Pos.of_nat (S k) else 0)).
Definition conditions_ok :=
  all p (fun k => all (N M) (fun l => forallb (meets l k) (zpoints (Fof k l)))).

Lemma all_at n c : all n c = true -> forall i, (i < n)%nat -> c i = true.
Proof. intros H i Hi. unfold all in H. rewrite forallb_forall in H. apply H, in_seq. lia. Qed.

Lemma nth_table {X} n (f : nat -> X) i d : (i < n)%nat -> nth i (table n f) d = f i.
Proof.
  intros H. unfold table. rewrite nth_indep with (d' := f 0%nat) by (rewrite map_length,
    seq_length; exact H).
  rewrite map_nth, seq_nth by exact H. reflexivity.
Qed.

Lemma seen_iff l m : sees M l m <-> is_seen l m = true.
Proof. unfold sees, is_seen. destruct (block M (space_of M l) m); split; congruence. Qed.

Hypothesis made : T = the_tables.

Lemma zone_val l : veq (val (zone l)) (oneof M l).
Proof.
  intros i. unfold val, zone, oneof; simpl. set (os := one_of M _).
  replace (nth i (map Qnum os) 0%Z) with (Qnum (nth i os 0)) by (symmetry; apply (map_nth Qnum os
    0)).
  destruct (nth_in_or_default i os 0) as [K|K]; [|rewrite K; reflexivity].
  revert K. generalize (nth i os 0) as q. intros q K. unfold os, one_of in K.
  apply in_map_iff in K. destruct K as [[j e] [<- _]].
  destruct (the_space M (space_of M l)); [destruct (Nat.eqb e 0)|destruct (Nat.eqb (j + e) 0)];
    reflexivity.
Qed.

Lemma P_val l x y : (l < N M)%nat ->
  veq (val (zmul (Pz l) x y)) (mul (Pof M l) (val x) (val y)).
Proof.
  intros H. unfold Pz, Pof. rewrite made. simpl. rewrite nth_table by exact H.
  unfold P_rows. rewrite product_table_is. apply zmul_val.
Qed.

Lemma A_rows_are l m : A_rows l m = rows M (space_of M l) m.
Proof.
  unfold A_rows, rows. destruct (block M _ m); [apply block_table_is|reflexivity].
Qed.
Lemma A_val l m x : (l < N M)%nat -> (m < N M)%nat ->
  veq (val (zapp (Az l m) x)) (app (Aof M l m) (val x)).
Proof.
  intros H K. unfold Az, Aof. rewrite made. simpl. rewrite !nth_table by assumption.
  rewrite A_rows_are. apply zapp_val.
Qed.

Lemma W_at l e : (e < degree M)%nat -> nth e (W_rows l) [] = weights M l e.
Proof.
  intros H. unfold W_rows. rewrite row_table_is. unfold weights. apply nth_table, H.
Qed.
Lemma b_val l e v : (l < N M)%nat -> (e < degree M)%nat ->
  b M l e (val v) == val (zapp (Wz l) v) e.
Proof.
  intros Hl He. unfold Wz. rewrite made. simpl. rewrite nth_table by exact Hl.
  rewrite (zapp_val _ v e). unfold b, app. rewrite W_at by exact He. reflexivity.
Qed.

Lemma meets_val l k v : (l < N M)%nat -> meets l k v = true <->
  forall e, (e < degree M)%nat ->
    b M l e (val v) == if Nat.eqb e 0 then 1 # Pos.of_nat (S k) else 0.
Proof.
  intros Hl. unfold meets, all. rewrite forallb_forall. split; intros H e He.
  - rewrite b_val by assumption. apply Qeq_bool_iff, H, in_seq. lia.
  - apply in_seq in He. apply Qeq_bool_iff. rewrite <- (H e) by lia. symmetry. apply b_val; lia.
Qed.

Theorem proved_order : starts_ok = true -> branches_ok = true -> products_ok = true ->
  conditions_ok = true -> has_order M p.
Proof.
  intros St Br Pr Co t Ho Ht.
  set (FF := fun k l => points (Fof k l)). set (GG := fun j l => points (Gof j l)).
  assert (H : hull (FF (order t - 1)%nat (root t)) (psi (Pof M) (Aof M) (oneof M) t)).
  { apply (trees_are_spanned (Pof M) (Aof M) (oneof M) (sees M) (N M) p FF GG);
      [| | |assumption|assumption].
    - intros l Hl. apply hull_ext with (1 := zone_val l).
      apply in_zhull_hull, (all_at _ _ St l Hl).
    - intros j l m Hj Hl Hm Hs a Ha. apply in_map_iff in Ha. destruct Ha as [z [<- Hz]].
      pose proof (all_at _ _ (all_at _ _ (all_at _ _ Br j ltac:(lia)) l Hl) m Hm) as K.
      cbv beta in K. rewrite (proj1 (seen_iff l m) Hs) in K. cbn [negb orb] in K.
      rewrite forallb_forall in K. specialize (K z Hz).
      apply in_zhull_hull in K. revert K. apply hull_ext.
      intros i. rewrite (A_val l m _ Hl Hm i). apply app_ext, zscale_val.
    - intros k l j Hk Hl Hj u w Hu Hw.
      apply in_map_iff in Hu. destruct Hu as [u' [<- Hu]].
      apply in_map_iff in Hw. destruct Hw as [w' [<- Hw]].
      pose proof (all_at _ _ (all_at _ _ (all_at _ _ Pr k Hk) l Hl) (j - 1)%nat ltac:(lia)) as K.
      cbv beta in K. replace (S (j - 1)) with j in K by lia.
      rewrite forallb_forall in K. specialize (K u' Hu). rewrite forallb_forall in K.
      specialize (K w' Hw). apply in_zhull_hull in K. revert K. apply hull_ext, P_val, Hl. }
  assert (Hl : (root t < N M)%nat) by (apply (colour_below (sees M) (N M)), Ht).
  pose proof (order_pos t) as Op.
  intros e He. apply H; [apply lin_linear|]. intros s Hs.
  apply in_map_iff in Hs. destruct Hs as [z [<- Hz]].
  pose proof (all_at _ _ (all_at _ _ Co (order t - 1)%nat ltac:(lia)) (root t) Hl) as K.
  cbv beta in K. rewrite forallb_forall in K. apply meets_val with (2 := K z Hz) in He; [|exact Hl].
  replace (S (order t - 1)) with (order t) in He by lia. exact He.
Qed.

(** ** A tree that fails *)

Fixpoint zpsi t : zvec :=
  match t with Node l us =>
    (fix product us := match us with
       | [] => zone l
       | u :: r => zmul (Pz l) (zapp (Az l (root u)) (zscale (order u) (zpsi u)))
                        (product r)
     end) us
  end.

Fixpoint is_admissible t : bool :=
  match t with Node l us =>
    Nat.ltb l (N M) &&
    (fix each us := match us with
       | [] => true | u :: r => is_seen l (root u) && is_admissible u && each r end) us
  end.

Lemma tree_ind' (P : tree -> Prop) :
  (forall l us, (forall u, In u us -> P u) -> P (Node l us)) -> forall t, P t.
Proof.
  intros H. fix IH 1. intros [l us]. apply H.
  induction us as [|u r IHr]; [contradiction|]. intros v [<-|K]; [apply IH|apply IHr, K].
Qed.

Lemma admissible_iff t : is_admissible t = true -> is_tree M t.
Proof.
  induction t as [l us IH] using tree_ind'. unfold is_tree. simpl. intros H.
  apply andb_prop in H. destruct H as [Hl H]. split; [apply Nat.ltb_lt, Hl|].
  induction us as [|u r IHr]; [exact I|].
  apply andb_prop in H. destruct H as [H Hr]. apply andb_prop in H. destruct H as [Hs Hu].
  split; [apply seen_iff, Hs|]. split; [apply IH; [left; reflexivity|exact Hu]|].
  apply IHr; [intros v K; apply IH; right; exact K|exact Hr].
Qed.

Lemma mul_ext P x x' y y' : veq x x' -> veq y y' -> veq (mul P x y) (mul P x' y').
Proof.
  intros H K i. unfold mul. rewrite (l_ext _ (bil_left (P i) y) x x' H).
  apply (l_ext _ (bil_right (P i) x')), K.
Qed.

Lemma veq_trans x y z : veq x y -> veq y z -> veq x z.
Proof. intros H K i. rewrite (H i). apply K. Qed.

Lemma zpsi_val t : is_tree M t -> veq (val (zpsi t)) (psi (Pof M) (Aof M) (oneof M) t).
Proof.
  induction t as [l us IH] using tree_ind'. unfold is_tree. simpl. intros [Hl Hus].
  induction us as [|u r IHr]; [apply zone_val|].
  destruct Hus as [Hs [Hu Hr]].
  eapply veq_trans; [apply P_val, Hl|]. apply mul_ext.
  - eapply veq_trans; [apply A_val; [exact Hl|apply (colour_below (sees M) (N M)), Hu]|].
  apply app_ext.
    eapply veq_trans; [apply zscale_val|]. intros i. unfold scale.
    rewrite (IH u (or_introl eq_refl) Hu i). reflexivity.
  - apply IHr; [intros v K; apply IH; right; exact K|exact Hr].
Qed.

Definition fails (t : tree) : bool :=
  is_admissible t && negb (meets (root t) (order t - 1) (zpsi t)).

Theorem proved_failure t : fails t = true -> is_tree M t /\ ~ holds M t.
Proof.
  intros H. apply andb_prop in H. destruct H as [Ha H]. apply admissible_iff in Ha.
  split; [assumption|]. intros C.
  assert (Hl : (root t < N M)%nat) by (apply (colour_below (sees M) (N M)), Ha).
  apply negb_true_iff in H. assert (K : meets (root t) (order t - 1) (zpsi t) = true);
    [|congruence].
  apply meets_val; [exact Hl|]. intros e He. pose proof (order_pos t).
  replace (S (order t - 1)) with (order t) by lia. rewrite <- (C e He).
  apply (l_ext _ (lin_linear _)), zpsi_val, Ha.
Qed.
End WithTables.
End Checker.

(** ** What is asked of a method: its order, and that it is no higher *)

Definition order_is_proved M p F G : bool :=
  let T := the_tables M in
  starts_ok M F && branches_ok M p F G T && products_ok M p F G T && conditions_ok M p F T.

Theorem has_order_by M p F G : order_is_proved M p F G = true -> has_order M p.
Proof.
  intros H. unfold order_is_proved in H. cbv zeta in H.
  repeat (apply andb_prop in H; destruct H as [H ?]).
  eapply proved_order; try eassumption. reflexivity.
Qed.

Theorem not_higher_by M p t :
  Nat.eqb (order t) (S p) && fails M (the_tables M) t = true -> ~ has_order M (S p).
Proof.
  intros H. apply andb_prop in H. destruct H as [O K].
  apply Nat.eqb_eq in O. destruct (proved_failure M _ eq_refl t K) as [Ht C].
  intros G. apply C, G; [lia|assumption].
Qed.
